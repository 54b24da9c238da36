#pragma once

#include <cmath>

#include "dynamics/contact/contact.hpp"

namespace polynya::simulation {

/// The force at which a contact's ice breaks, no more than was entered before [N]. One that is found deeper
/// than that broke on the way, at the share (F_b/F)^(1/n) of its depth, with F ∝ ξ^n.
inline void break_at(dynamics::Contact& c, double force) {
  const double most = std::fmin(c.crushing_force, c.breaking_force);
  if (force < c.breaking_force) c.breaking_force = force;
  if (c.missed_impulse == 0 || most <= force) return;
  const double exponent = c.crushing_stiffness * c.depth / c.crushing_force;
  const double share_of_force = force / most;
  c.missed_impulse *= share_of_force * (exponent > 0 ? std::pow(share_of_force, 1 / exponent) : 1);
}

}  // namespace polynya::simulation
