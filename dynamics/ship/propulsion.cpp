#include "dynamics/ship/propulsion.hpp"

#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"

namespace polynya::dynamics {
double bollard_pull(double power, double diameter, int propellers, bool has_nozzles) {
  const double k_e = propellers == 1 ? 0.78 : propellers == 2 ? 0.98 : 1.12;
  const double pull = k_e * elementary::pow(1e-3 * power * diameter, 2 / 3.0);
  return 1e3 * (has_nozzles ? 1.4 : 1.0) * pull;
}

double thrust_at(const Engine& engine, double lever) {
  const double thrust = engine.bollard_pull * elementary::pow(std::abs(lever), 2 / 3.0);
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

Planar turned_thrust(double thrust, double angle, double x) {
  const double side = -thrust * elementary::sin(angle);
  return {thrust * elementary::cos(angle), side, x * side};
}

}  // namespace polynya::dynamics
