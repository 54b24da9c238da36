#pragma once

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// Two bodies at a point of contact, as Eq. (5) sees them. Prescribed motion: inverse mass and moment are 0.
struct Mobility {
  double inverse_mass = 0;    ///< [1/kg]
  double inverse_moment = 0;  ///< [1/(kg m²)]
  geometry::Vector arm;       ///< from the centre of mass to the contact point [m]
};

/// 1 / [1/m_i + 1/m_k + (r_i × n)²/I_i + (r_k × n)²/I_k]: the effective mass against an impulse along n at
/// the contact [kg]. Eq. (5) of [Sawamura2017]. Deviation: as printed r_i and r_k are crossed; that reading
/// gains energy.
inline double effective_mass(const Mobility& i, const Mobility& k, geometry::Vector direction) {
  const double arm_cross_i = cross(i.arm, direction);
  const double arm_cross_k = cross(k.arm, direction);
  return 1 / (i.inverse_mass + k.inverse_mass + arm_cross_i * arm_cross_i * i.inverse_moment +
              arm_cross_k * arm_cross_k * k.inverse_moment);
}

/// j = (1 + ε) v_n m_eff [N s] for an approach speed v_n > 0 [m/s], 0 otherwise. Eq. (5) of [Sawamura2017].
inline double collision_impulse(double approach_speed, double restitution, double effective_mass) {
  return approach_speed > 0 ? (1 + restitution) * approach_speed * effective_mass : 0;
}

}  // namespace polynya::dynamics
