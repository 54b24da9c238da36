#pragma once

#include <vector>

#include "dynamics/contact/contact.hpp"

namespace polynya::dynamics {

struct SeparationSettings {
  double time = 1.0;   ///< decay time of overlap that nothing presses together any more [s]
  double slop = 1e-4;  ///< overlap that is allowed [m]
};

/// Moves overlapping bodies apart without giving them speed (split impulse): along the normals, in
/// proportion to their inverse masses, the overlap beyond what crushing made decays over the settings' time.
/// Returns how many contacts it moved.
int separate(Bodies& bodies, const std::vector<Contact>& contacts, const SeparationSettings& settings,
             double dt);

}  // namespace polynya::dynamics
