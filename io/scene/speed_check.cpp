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

}  // namespace

void check_speeds(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems) {
  const simulation::Scene& scene = draft.scene;
  const dynamics::ShearCurrent current = simulation::current_of(scene.water.shear);
  Fastest fastest{length(scene.water.drift), "the drift"};
  const auto check = [&](double speed, const std::string& path, const Origin& origin) {
    if (speed > fastest.speed) fastest = {speed, path};
    if (speed < simulation::kRunawaySpeed) return;
    problems.add(origin.source, origin.offset,
                 {.path = path,
                  .found = fmt::format("a rim that moves at {:.4g} m/s at the start", speed),
                  .allowed = fmt::format("less than {:g} m/s, the water's shear included",
                                         simulation::kRunawaySpeed)});
  };
  for (std::size_t i = 0; i < scene.ships.size(); ++i)
    check(speed_of(scene, scene.ships[i]), ship_path(draft, i), draft.ship_origins[i]);
  for (std::size_t i = 0; i < scene.floes.size(); ++i)
    check(rim_speed_of(current, scene.floes[i]), floe_path(draft, i), draft.floe_origins[i]);
  const double radius = scene.contact.circle_radius;
  if (fastest.speed >= simulation::kRunawaySpeed) return;  // no step helps
  if (!(fastest.speed * scene.time.step >= radius)) return;
  problems.add(
      0, nearest_offset(resolved, "time.step_s"),
      {.path = "time.step_s",
       .found = fmt::format("{}: {} moves {:.3g} m in one step at {:.3g} m/s", scene.time.step, fastest.path,
                            fastest.speed * scene.time.step, fastest.speed),
       .allowed = fmt::format("a step in which nothing moves as far as a circle's radius, {} m", radius)});
}

}  // namespace polynya::io
