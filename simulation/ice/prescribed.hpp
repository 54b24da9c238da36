#pragma once

#include "simulation/ship/ship_contact_load.hpp"

namespace polynya::simulation {

/// Whether nothing moves the two bodies of a contact: a hull in fast ice.
inline bool is_prescribed(const dynamics::Bodies& bodies, const dynamics::Contact& c) {
  return bodies.inverse_mass[c.a] == 0 && bodies.inverse_mass[c.b] == 0;
}

/// The most that ice can bear along a contact line as long as the smaller of its two bodies is wide,
/// σ_c h 2R (1 + μ tan θ_s) [N].
double most_that_ice_bears(const Setup& setup, const Population& population, const dynamics::Contact& c,
                           double slope_tangent);

/// How fast the force of a contact between prescribed bodies may grow, so that at the end of the step it is no
/// more than ice bears. Nothing gives way there: the growth that a shallow overlap shows would act all step.
/// `load`: its normal force and stiffness are limited.
void limit_prescribed(const Setup& setup, const Population& population, ShipContactLoad& load);

}  // namespace polynya::simulation
