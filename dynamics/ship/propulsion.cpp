#include "dynamics/ship/propulsion.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::dynamics {
double bollard_pull(double power, double diameter, int propellers, bool has_nozzles) {
  const double k_e = propellers == 1 ? 0.78 : propellers == 2 ? 0.98 : 1.12;
  const double pull = k_e * std::pow(1e-3 * power * diameter, 2 / 3.0);
  return 1e3 * (has_nozzles ? 1.4 : 1.0) * pull;
}

double thrust_at(const Engine& engine, double lever) {
  const double thrust = engine.bollard_pull * std::pow(std::abs(lever), 2 / 3.0);
  return lever < 0 ? -engine.astern_share * thrust : thrust;
}

double propeller_thrust(const Engine& engine, double lever, double speed) {
  return thrust_at(engine, lever) - engine.bollard_pull * speed / (3 * engine.open_water_speed);
}

double quadratic_resistance(const Engine& engine) {
  return 2 / 3.0 * engine.bollard_pull / (engine.open_water_speed * engine.open_water_speed);
}

double net_thrust(const Engine& engine, double lever, double speed) {
  return propeller_thrust(engine, lever, speed) - quadratic_resistance(engine) * std::abs(speed) * speed;
}

double approach(double setting, double wanted, double rate, double dt) {
  return std::clamp(wanted, setting - rate * dt, setting + rate * dt);
}

Planar rudder_force(const Rudder& rudder, double angle, Planar through_water, double thrust, double density) {
  constexpr double kRaceInAngle = 0.02;  // own regularisation
  const double u = through_water.surge;
  const double race =
      rudder.race_area > 0 ? rudder.race_coefficient * 2 * std::max(0.0, thrust) / (density * rudder.race_area) : 0;
  const double hull_flow = (1 - rudder.wake_fraction) * u;
  const double axial_squared = hull_flow * std::abs(hull_flow) + race;
  const double side = std::copysign(1.0, axial_squared);  // that the flow comes from: ahead or astern
  const double across = through_water.sway + rudder.position * through_water.yaw;
  const double inflow = std::atan2(across, std::sqrt(u * u + kRaceInAngle * race));
  const double slope = 6.13 * rudder.aspect_ratio / (rudder.aspect_ratio + 2.25);
  const double normal =
      0.5 * density * rudder.area * slope * axial_squared * std::sin(angle + side * rudder.flow_straightening * inflow);
  const double sway = -(1 + rudder.hull_factor) * normal * std::cos(angle);
  return {-normal * std::sin(angle), sway, rudder.position * sway};
}

Planar turned_thrust(double thrust, double angle, double x) {
  const double side = -thrust * std::sin(angle);
  return {thrust * std::cos(angle), side, x * side};
}

}  // namespace polynya::dynamics
