#include "simulation/world/levels.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include "geometry/exact/measures.hpp"

namespace polynya::simulation {
namespace {

/// The longest step in which a hull stays within its share of the ice that is at it [s].
double longest_step(const Setup& setup, const Population& population, BodyIndex hull) {
  const dynamics::Bodies& bodies = population.bodies;
  double longest = setup.scene.time.step;
  const auto way = [&](BodyIndex other) { return most_way(setup.scene.contact, bodies.thickness[other]); };
  const auto speed = [&](BodyIndex other) { return length(bodies.velocity[hull] - bodies.velocity[other]); };
  population.pairs.for_bodies_at(
      bodies, hull, [&](BodyIndex other) { return !population.is_hull(other) && speed(other) * longest > way(other); },
      [&](BodyIndex other) { longest = way(other) / speed(other); });
  return longest;
}

/// In ice, at most: as at the start, or as its engine makes it in open water [m/s].
double full_speed(const Ship& ship) {
  const double start = std::hypot(ship.speed, ship.sway_speed);
  if (const auto* engine = std::get_if<Engine>(&ship.propulsion)) return std::max(start, engine->open_water_speed);
  const auto* constant = std::get_if<ConstantThrust>(&ship.propulsion);
  return constant && constant->thrust != 0 ? std::max(start, kUnderThrust) : start;
}

/// At which the wind drives ice through the water, at most [m/s].
double wind_drift(const Scene& scene) {
  double fastest = length(free_drift(scene, 0) - scene.water.drift_at(0));
  for (const dynamics::FlowRow& row : scene.wind.rows)
    fastest = std::max(fastest, length(free_drift(scene, row.time) - scene.water.drift_at(row.time)));
  return fastest;
}

/// Through the water, at the start, at most [m/s].
double fastest_floe(const Scene& scene) {
  double fastest = 0;
  for (const FloeSpec& floe : scene.floes) fastest = std::max(fastest, length(floe.velocity));
  return fastest;
}

/// At which a hull and ice meet, or floes where there is no hull, at most [m/s].
double fastest_meeting(const Scene& scene) {
  const dynamics::ShearCurrent current = current_of(scene.water.shear);
  double of_hulls = 0;
  const auto meet = [&](const PlacedHull& hull, double speed) {
    of_hulls = std::max(of_hulls, speed + length(current.velocity_at(hull.position_in_world)));
  };
  for (const Ship& ship : scene.ships) meet(ship, full_speed(ship));
  for (const Structure& structure : scene.structures) meet(structure, 0);
  for (const Wall& wall : scene.walls) meet(wall, wall.pressure ? wall.pressure->closing_speed : length(wall.velocity));
  return of_hulls + fastest_floe(scene) + wind_drift(scene) + scene.water.fastest_drift();
}

/// Of any floe's rim at the start, at most [m/s].
double fastest_rim(const Scene& scene) {
  const dynamics::ShearCurrent current = current_of(scene.water.shear);
  double fastest = 0;
  for (const FloeSpec& floe : scene.floes) {
    const geometry::Box box = bounding_box(floe.polygon_in_world.outer);
    const double turning = std::abs(floe.angular_velocity + current.angular_velocity()) * distance(box.low, box.high);
    fastest = std::max(fastest, length(floe.velocity + current.velocity_at(midpoint(box.low, box.high))) + turning);
  }
  return fastest;
}

/// Of walls that press: in which their load takes them to their closing speed, and kTickUnderPressure [s].
double longest_by_walls(const Scene& scene) {
  double longest = std::numeric_limits<double>::infinity();
  for (const Wall& wall : scene.walls)
    if (const auto& p = wall.pressure; p && p->line_load > 0)
      longest = std::min({longest, kTickUnderPressure, p->closing_speed * p->mass_per_length / p->line_load});
  return longest;
}

/// What kMostIce of the ice is thicker than, by area [m].
double thin_ice(const Scene& scene) {
  if (scene.own_ice.empty() || scene.floes.empty()) return scene.ice.thickness;
  std::vector<std::pair<double, double>> ice;  // thickness, area
  double rest = 0;
  for (const FloeSpec& floe : scene.floes) {
    ice.emplace_back(ice_of(scene, floe.own_ice).thickness, geometry::measure(floe.polygon_in_world).area);
    rest += (1 - kMostIce) * ice.back().second;
  }
  std::ranges::sort(ice);
  const auto found = std::ranges::find_if(ice, [&](const auto& of) { return (rest -= of.second) < 0; });
  return found == ice.end() ? ice.back().first : found->first;
}

}  // namespace

double most_way(const ContactSettings& contact, double thickness) {
  return std::min(
      {kWayOverThickness * thickness, kWayTimesThickness / thickness, kWayOverCircle * contact.circle_radius});
}

double most_way_of_floes(const ContactSettings& contact, double thickness) {
  return std::min(kFloesWayOverThickness * thickness, kWayOverCircle * contact.circle_radius);
}

double default_tick(const Scene& scene) {
  const bool has_parts = scene.contact.law == ContactLaw::kCrush && scene.time.levels > 0;
  const double radius = scene.contact.circle_radius;
  const double way = most_way(scene.contact, thin_ice(scene));
  const double of_hulls = std::min((has_parts ? kTickOverStep : 1) * way, radius / 2);  // they have parts of ticks
  const double longest =
      std::min({of_hulls / fastest_meeting(scene), way / fastest_floe(scene),
                kWayOverCircle * radius / fastest_rim(scene), longest_by_walls(scene), scene.time.until});
  const auto goes_into = [](double tick, double interval) {
    const double times = std::round(interval / tick);
    return times >= 1 && std::abs(interval / tick - times) < 1e-6 * times;
  };
  const auto fits = [&](double tick) { return tick <= longest * (1 + 1e-9); };
  for (const double tick : kTickChoices)
    if (fits(tick) && goes_into(tick, scene.record.forces_interval) && goes_into(tick, scene.record.frames_interval))
      return tick;
  const auto* found = std::ranges::find_if(kTickChoices, fits);
  return found == kTickChoices.end() ? std::min(kTickChoices.back(), scene.time.until) : *found;
}

int parts_of_tick(const Setup& setup, const Clock& clock, const Population& population) {
  const int most = 1 << setup.levels;
  if (most == 1) return 1;
  double longest = setup.scene.time.step;
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    longest = std::min(longest, longest_step(setup, population, hull));
  const double needed = std::min<double>(most, std::ceil(setup.scene.time.step / longest / kWayExceeded));
  return std::min(most, static_cast<int>(needed) * clock.finer);
}

bool follow_bends(const Setup& setup, std::int64_t bends, Clock& clock) {
  if (setup.levels == 0) return false;
  const double in_a_step = static_cast<double>(bends) / clock.parts;
  clock.bends += kLastTick * (in_a_step - clock.bends);
  const bool is_finest = clock.parts == 1 << setup.levels;
  if (clock.bends > kMostBends && !is_finest) {
    clock.finer *= 2;
    clock.bends /= 2;
  } else if (clock.bends < kFewBends && clock.finer > 1) {
    clock.finer /= 2;
    clock.bends *= 2;
  }
  return is_finest && clock.bends > kCrowded;
}

}  // namespace polynya::simulation
