#include "dynamics/ship/rudder.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "elementary/elementary.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Vector;

constexpr double kPi = std::numbers::pi;
/// Ratio of effective to geometric aspect ratio of a blade below a hull [-]: 2 if the hull acts as a mirror, 1 if it is
/// far off.
constexpr double kHullMirror = 1.5;
constexpr double kCrossFlow = 0.8;     ///< C_Dc of the flow round the tips [WhickerFehlner1958] (recall) [-]
constexpr double kOswald = 0.9;        ///< share of the ideal induced drag's aspect ratio (same source) [-]
constexpr double kPlateNormal = 1.17;  ///< normal force of a plate with a broken-off flow, over ½ρ V² A (recall) [-]
constexpr double kStock = 0.25;       ///< place of the stock, which stands in the race's axis, behind the nose [chords]
constexpr double kStallWidth = 0.25;  ///< width over which the flow breaks off, as a share of the stall angle [-]

/// Slope of the lift coefficient at small incidence [1/rad] [WhickerFehlner1958].
double lift_slope(double aspect_ratio) {
  return 1.8 * kPi * aspect_ratio / (1.8 + std::sqrt(aspect_ratio * aspect_ratio + 4));
}

/// Incidence at which the flow begins to break off [rad] [Lloyd1989].
double stall_angle(double aspect_ratio) {
  const double a = std::min(aspect_ratio, 3.0);
  return 1.05 - 0.445 * a + 0.075 * a * a;
}

/// Share of the flow that has broken off: 0 up to the stall angle, 1 from 1.25 times that angle on.
double broken_off(double aspect_ratio, double incidence) {
  const double stall = stall_angle(aspect_ratio);
  const double x = std::clamp((incidence - stall) / (kStallWidth * stall), 0.0, 1.0);
  return x * x * (3 - 2 * x);
}

LiftAndDrag mean_of(double share, LiftAndDrag a, LiftAndDrag b) {
  return {share * a.lift + (1 - share) * b.lift, share * a.drag + (1 - share) * b.drag};
}

/// Returns the lift and drag of a force that is normal to the blade's chord.
LiftAndDrag of_normal_force(double normal, double incidence) {
  return {normal * elementary::cos(incidence), normal * elementary::sin(incidence)};
}

/// Returns the fraction of a round race that hits a blade at an incidence; the rest passes ahead of its nose and behind
/// its tail.
double share_met(double aspect_ratio, double incidence) {
  const auto within = [](double radii) {  // fraction of a circle up to a chord at this distance from its centre
    const double x = std::min(radii, 1.0);
    return 1 - (elementary::acos(x) - x * std::sqrt(1 - x * x)) / kPi;
  };
  const double reach =
      2 * elementary::sin(incidence) / aspect_ratio;  // extent of the chord across the race, in the race's radii
  return within(kStock * reach) + within((1 - kStock) * reach) - 1;
}

/// How a blade moves through the water around it.
struct BladeFlow {
  double ahead = 0;   ///< [m/s]
  double across = 0;  ///< to port [m/s]
  double squared() const { return ahead * ahead + across * across; }
  double direction() const { return elementary::atan2(across, ahead); }
};

/// Force on a blade at an angle δ, in the ship's axes.
Vector force_in_ship(LiftAndDrag over, double size, const BladeFlow& flow) {
  const double direction = flow.direction();
  const Vector along{elementary::cos(direction), elementary::sin(direction)};
  return -size * (over.drag * along + over.lift * perpendicular(along));
}

/// One blade, and the part of it in the race.
struct Blade {
  double area = 0;          ///< [m²]
  double aspect_ratio = 0;  ///< [-]
  double chord = 0;         ///< [m]
  double in_race = 0;       ///< height of the part in the race [m]
};

Vector in_endless_flow(double area, const Blade& blade, double angle, const BladeFlow& flow, double density) {
  const LiftAndDrag over = foil_in_endless_flow(kHullMirror * blade.aspect_ratio, angle + flow.direction());
  return force_in_ship(over, 0.5 * density * area * flow.squared(), flow);
}

/// Returns the force on the part of a blade in the race. A race that is much faster than the water around it is turned;
/// in a race as slow as the water around it the blade is in an endless flow. Between them the force is weighted by the
/// strength of the images of a lifting line in a round jet, (V² − U²)/(V² + U²) [Koning1935].
Vector in_race(const Blade& blade, double angle, const BladeFlow& race, const BladeFlow& around, double density) {
  const Vector endless = in_endless_flow(blade.chord * blade.in_race, blade, angle, race, density);
  if (race.ahead <= 0) return endless;
  const double outside = elementary::pow(std::max(0.0, around.ahead), 2) + around.across * around.across;
  const double jet = std::max(0.0, race.squared() - outside) / (race.squared() + outside);
  const double momentum = density * 0.25 * kPi * elementary::pow(blade.in_race * race.ahead, 2);
  const LiftAndDrag over = foil_in_race(blade.in_race / blade.chord, angle + race.direction());
  return jet * force_in_ship(over, momentum, race) + (1 - jet) * endless;
}

}  // namespace

Race race_behind(double propeller_area, bool has_nozzle, double thrust, double advance, double density) {
  const double gain = std::max(0.0, thrust) / (density * propeller_area);  // [m²/s²]
  const auto root = [](double squared) { return std::copysign(std::sqrt(std::abs(squared)), squared); };
  const double ahead = std::max(0.0, advance);
  double speed = root(advance * std::abs(advance) + (has_nozzle ? 1 : 2) * gain);
  if (has_nozzle && advance > 0) speed = 0.5 * advance + std::sqrt(0.25 * advance * advance + gain);
  const double contracted = has_nozzle ? 1 : speed > 0 ? 0.5 * (1 + ahead / speed) : 0.5;
  return {speed, std::sqrt(4 / kPi * contracted * propeller_area)};
}

LiftAndDrag foil_in_endless_flow(double aspect_ratio, double incidence) {
  const double from_chord = std::remainder(incidence, kPi);  // both ends of the blade are treated alike
  const double a = std::abs(from_chord);
  const double s = elementary::sin(a);
  LiftAndDrag attached;
  attached.lift = lift_slope(aspect_ratio) * s + kCrossFlow / std::max(1.0, aspect_ratio) * s * s;
  attached.drag = attached.lift * attached.lift / (kOswald * kPi * aspect_ratio);
  LiftAndDrag over = mean_of(broken_off(aspect_ratio, a), of_normal_force(kPlateNormal, a), attached);
  over.lift = std::copysign(over.lift, from_chord);
  return over;
}

LiftAndDrag foil_in_race(double aspect_ratio, double incidence) {
  const double from_chord = std::remainder(incidence, kPi);
  const double a = std::abs(from_chord);
  const double over_momentum = 2 / (kPi * aspect_ratio);  // ½ V² A over V² π d²/4
  const double turned =
      over_momentum * lift_slope(aspect_ratio) * elementary::sin(a);  // sine of the race's angle, below 0.95
  const LiftAndDrag attached{turned, 1 - std::sqrt(1 - turned * turned)};
  const double normal = std::min(share_met(aspect_ratio, a) * elementary::sin(a), over_momentum * kPlateNormal);
  LiftAndDrag over = mean_of(broken_off(aspect_ratio, a), of_normal_force(normal, a), attached);
  over.lift = std::copysign(over.lift, from_chord);
  return over;
}

Planar rudder_force(const Rudder& rudder, double angle, Planar through_water, double thrust, double density) {
  Blade blade;
  blade.area = rudder.area / rudder.count;
  blade.aspect_ratio = rudder.aspect_ratio;
  blade.chord = std::sqrt(blade.area / blade.aspect_ratio);
  const double across = rudder.flow_straightening * (through_water.sway + rudder.position * through_water.yaw);
  const BladeFlow around{(1 - rudder.wake_fraction) * through_water.surge, across};
  Vector of_race, with_hull;
  const double height = blade.chord * blade.aspect_ratio;
  if (rudder.propeller_area > 0) {
    const Race race =
        race_behind(rudder.propeller_area, rudder.has_nozzle, rudder.thrust_share * thrust, around.ahead, density);
    blade.in_race = std::min(height, race.diameter);
    of_race = in_race(blade, angle, {race.speed, across}, around, density);
    // The pressure that a blade's lift makes on the hull grows with the speed of the hull's own flow.
    with_hull = std::min(1.0, std::abs(around.ahead) / std::max(std::abs(race.speed), 1e-9)) * of_race;
  }
  const double outside = blade.area - blade.chord * blade.in_race;
  const Vector of_rest = in_endless_flow(outside, blade, angle, around, density);
  with_hull += of_rest;
  const double sway = rudder.count * (of_race.y + of_rest.y + rudder.hull_factor * with_hull.y);
  return {rudder.count * (of_race.x + of_rest.x), sway, rudder.position * sway};
}

}  // namespace polynya::dynamics
