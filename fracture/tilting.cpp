#include "fracture/tilting.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polynya::fracture {

double TiltResistance::at(double deflection) const {
  return std::min(stiffness * deflection, capacity);
}

TiltResistance tilt_resistance(const Ice& ice, const Water& water, double area, double added_mass_factor) {
  const double root = std::sqrt(ice.density / water.density);
  const double radius = std::sqrt(area / std::numbers::pi);
  const double added = added_mass_factor * 4 / 3 * water.density * radius * radius * radius;
  return {.stiffness = water.density * kGravity * area / 4,
          .capacity = water.density * kGravity * ice.thickness * area * root * (1 - root),
          .mass = (ice.density * ice.thickness * area + added) / 4};
}

double most_vertical_force(const TiltResistance& resistance, const EdgeMotion& motion, double slide_speed, double dt) {
  return resistance.at(motion.deflection) + resistance.mass * std::max(0.0, slide_speed - motion.rate) / dt;
}

EdgeMotion tilted(const TiltResistance& resistance, const EdgeMotion& motion, double vertical_force, double damping,
                  double dt) {
  const double frequency = std::sqrt(resistance.stiffness / resistance.mass);
  const double pushed = motion.rate + dt * (vertical_force - resistance.at(motion.deflection)) / resistance.mass;
  const double rate = pushed / (1 + damping * frequency * dt);
  const double deflection = motion.deflection + dt * rate;
  if (deflection <= 0) return {};
  return {deflection, rate};
}

}  // namespace polynya::fracture
