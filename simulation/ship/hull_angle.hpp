#pragma once

#include "dynamics/contact/contact.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// θ_s where the contact is: by the waterline's normal from the stem angle, or from the hull's own table
/// [rad].
double hull_angle_at(const Hull& hull, const dynamics::Bodies& bodies, const dynamics::Contact& c);

}  // namespace polynya::simulation
