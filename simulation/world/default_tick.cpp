#include "simulation/world/default_tick.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <utility>
#include <vector>

#include "elementary/elementary.hpp"
#include "geometry/exact/measures.hpp"
#include "simulation/world/parts.hpp"

namespace polynya::simulation {
namespace {

/// Round tick lengths from which default_tick() chooses, the longest first [s].
constexpr std::array kTickChoices{0.1, 0.05, 0.025, 0.02, 0.01, 0.005, 0.0025, 0.002, 0.001, 0.0005};
/// Number of parts that a tick may need for the fastest hull at its full speed [-], a quarter of kMostParts. The other
/// parts are left for ice in which a hull must move less, and for ticks with many bends (Pace::finer). A larger value
/// leaves too few parts for these; a smaller one makes ticks shorter than a ship below her full speed needs.
constexpr double kPartsAtFullSpeed = 8;
/// Speed in ice that is assumed of a ship with a constant thrust [m/s], because the scene does not give it. A larger
/// value makes ticks shorter; with a smaller one, ticks of faster ships need more parts.
constexpr double kSpeedUnderThrust = 4;
/// Fraction of the scene's ice by area for which the tick is chosen [-]. Where a hull meets the rest, ticks are divided
/// into more parts. A larger value makes ticks shorter for a few thin or very thick floes.
constexpr double kMostIce = 0.95;

/// Returns the greatest speed of a ship [m/s]: the speed at the start, which a prescribed ship keeps, or the open-water
/// speed of its engine or the speed assumed of a constant thrust, if that is greater.
double full_speed(const Ship& ship) {
  const double start = elementary::hypot(ship.speed, ship.sway_speed);
  if (const auto* engine = std::get_if<Engine>(&ship.propulsion)) return std::max(start, engine->open_water_speed);
  const auto* constant = std::get_if<ConstantThrust>(&ship.propulsion);
  return constant && constant->thrust != 0 ? std::max(start, kSpeedUnderThrust) : start;
}

/// Returns the greatest speed at which the wind drives ice through the water [m/s].
double wind_drift(const Scene& scene) {
  double fastest = length(free_drift(scene, 0) - scene.water.drift_at(0));
  for (const dynamics::FlowRow& row : scene.wind.rows)
    fastest = std::max(fastest, length(free_drift(scene, row.time) - scene.water.drift_at(row.time)));
  return fastest;
}

/// Returns the greatest speed of a floe at the start [m/s]. The speed of fast ice is over ground, and drifting ice may
/// move towards it: `drift_of_others` [m/s] is therefore added to the speed of fast ice.
double fastest_floe(const Scene& scene, double drift_of_others = 0) {
  double fastest = 0;
  for (const FloeSpec& floe : scene.floes)
    fastest = std::max(fastest, length(floe.velocity) + (floe.is_fast ? drift_of_others : 0));
  return fastest;
}

/// Returns the greatest speed at which a hull and ice meet, or floes where there is no hull [m/s].
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

/// Returns the greatest speed of any floe's rim at the start [m/s].
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

/// Returns the displacement of a hull in a part, allowed_displacement(), that the fraction kMostIce of the scene's ice
/// allows, by area [m]. It is smaller for thin ice and for very thick ice.
double displacement_in_most_ice(const Scene& scene) {
  if (scene.own_ice.empty() || scene.floes.empty()) return allowed_displacement(scene.contact, scene.ice.thickness);
  std::vector<std::pair<double, double>> ice;  // displacement [m] and area [m²] of each floe
  double rest = 0;
  for (const FloeSpec& floe : scene.floes) {
    const double displacement = allowed_displacement(scene.contact, ice_of(scene, floe.own_ice).thickness);
    ice.emplace_back(displacement, geometry::measure(floe.polygon_in_world).area);
    rest += (1 - kMostIce) * ice.back().second;
  }
  std::ranges::sort(ice);
  const auto found = std::ranges::find_if(ice, [&](const auto& of) { return (rest -= of.second) < 0; });
  return found == ice.end() ? ice.back().first : found->first;
}

/// Returns the longest tick that satisfies the conditions on the motion of bodies (default_tick.hpp) [s].
double longest_tick(const Scene& scene) {
  const double radius = scene.contact.circle_radius;
  const double displacement = displacement_in_most_ice(scene);
  const double parts = scene.contact.law == ContactLaw::kCrush ? kPartsAtFullSpeed : 1;
  const double drift = scene.water.fastest_drift() + wind_drift(scene);
  return std::min({parts * displacement / fastest_meeting(scene), displacement / fastest_floe(scene, drift),
                   kDisplacementOverRadius * radius / fastest_rim(scene)});
}

/// Returns the longest of the choices that is no longer than a time and divides each interval [s]. If no choice does,
/// the intervals are ignored. If all choices are longer than the time, returns the shortest one.
double chosen_tick(double longest, std::initializer_list<double> intervals) {
  const auto goes_into = [](double tick, double interval) {
    const double times = std::round(interval / tick);
    return times >= 1 && std::abs(interval / tick - times) < 1e-6 * times;
  };
  const auto fits = [&](double tick) { return tick <= longest * (1 + 1e-9); };
  for (const double tick : kTickChoices)
    if (fits(tick) && std::ranges::all_of(intervals, [&](double interval) { return goes_into(tick, interval); }))
      return tick;
  const auto* found = std::ranges::find_if(kTickChoices, fits);
  return found == kTickChoices.end() ? kTickChoices.back() : *found;
}

}  // namespace

double default_tick(const Scene& scene) {
  return chosen_tick(longest_tick(scene), {scene.record.forces_interval, scene.record.frames_interval});
}

double tick_for_any_interval(const Scene& scene) {
  return chosen_tick(longest_tick(scene), {});
}

}  // namespace polynya::simulation
