#include "io/scene/speed_check.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "io/scene/scene_check.hpp"
#include "simulation/limits.hpp"
#include "simulation/setup.hpp"

namespace polynya::io {
namespace {

using geometry::Point;

/// At the start [m/s].
double speed_of(const simulation::Scene& scene, const simulation::ShipSpec& ship) {
  const auto* constant = std::get_if<simulation::ConstantThrust>(&ship.propulsion);
  const auto* engine = std::get_if<simulation::Engine>(&ship.propulsion);
  const double thrust = constant ? std::abs(constant->thrust) : engine ? engine->bollard_pull : 0;
  const double gained = thrust / ship.mass * scene.time.step;
  return std::abs(ship.speed) + gained;
}

/// Of its rim at the start [m/s]; 0 of what can be no floe, which is refused for that.
double rim_speed_of(const dynamics::ShearCurrent& current, const simulation::FloeSpec& floe) {
  const geometry::Measures measures = geometry::measure(floe.polygon_in_world);
  if (!simulation::can_be_floe(measures)) return 0;
  double radius = 0;
  for (const Point p : floe.polygon_in_world.outer) radius = std::max(radius, distance(p, measures.centroid));
  return length(floe.velocity + current.velocity_at(measures.centroid)) +
         std::abs(floe.angular_velocity + current.angular_velocity()) * radius;
}

/// The fastest body so far.
struct Fastest {
  double speed = 0;  ///< [m/s]
  std::string path;
};

void report_runaway(const Fastest& body, const Origin& origin, ProblemCollector& problems) {
  if (body.speed < simulation::kRunawaySpeed) return;
  problems.add(
      origin.source, origin.offset,
      {.path = body.path,
       .found = fmt::format("a rim that moves at {:.4g} m/s at the start", body.speed),
       .allowed = fmt::format("less than {:g} m/s, the water's shear included", simulation::kRunawaySpeed)});
}

/// Of the water and the ships.
Fastest fastest_ship(const SceneDraft& draft) {
  Fastest fastest{length(draft.scene.water.drift), "the drift"};
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i)
    if (const double speed = speed_of(draft.scene, draft.scene.ships[i]); speed > fastest.speed)
      fastest = {speed, ship_path(draft, i)};
  return fastest;
}

bool is_too_fast_for_step(const Fastest& fastest, const simulation::Scene& scene) {
  return fastest.speed < simulation::kRunawaySpeed &&  // else no step helps
         fastest.speed * scene.time.step >= scene.contact.circle_radius;
}

void report_step(const Fastest& fastest, const simulation::Scene& scene, const JsonValue& resolved,
                 ProblemCollector& problems) {
  problems.add(0, nearest_offset(resolved, "time.step_s"),
               {.path = "time.step_s",
                .found = fmt::format("{}: {} moves {:.3g} m in one step at {:.3g} m/s", scene.time.step,
                                     fastest.path, fastest.speed * scene.time.step, fastest.speed),
                .allowed = fmt::format("a step in which nothing moves as far as a circle's radius, {} m",
                                       scene.contact.circle_radius)});
}

}  // namespace

void check_speeds_of_ships(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems) {
  for (std::size_t i = 0; i < draft.scene.ships.size(); ++i)
    report_runaway({speed_of(draft.scene, draft.scene.ships[i]), ship_path(draft, i)}, draft.ship_origins[i],
                   problems);
  const Fastest fastest = fastest_ship(draft);
  if (is_too_fast_for_step(fastest, draft.scene)) report_step(fastest, draft.scene, resolved, problems);
}

void check_speeds_of_floes(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems) {
  const simulation::Scene& scene = draft.scene;
  const dynamics::ShearCurrent current = simulation::current_of(scene.water.shear);
  Fastest fastest = fastest_ship(draft);
  if (is_too_fast_for_step(fastest, scene)) return;  // reported with the ships
  for (std::size_t i = 0; i < scene.floes.size(); ++i) {
    const double speed = rim_speed_of(current, scene.floes[i]);
    if (speed <= fastest.speed && speed < simulation::kRunawaySpeed) continue;
    const Fastest floe{speed, floe_path(draft, i)};
    report_runaway(floe, draft.floe_origins[i], problems);
    if (speed > fastest.speed) fastest = floe;
  }
  if (is_too_fast_for_step(fastest, scene)) report_step(fastest, scene, resolved, problems);
}

}  // namespace polynya::io
