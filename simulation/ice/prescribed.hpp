#pragma once

#include "simulation/ship/hull_contact_load.hpp"

namespace polynya::simulation {

/// Returns the longest contact line that two bodies can have across the contact's normal: the extent of the smaller
/// body in that direction [m].
double longest_line(const dynamics::Bodies& bodies, const dynamics::Contact& c);

/// Returns the largest horizontal force that the ice at a contact can carry: σ_c h W (1 + μ tan θ_s) with the length W
/// of the longest line [N]. `slope_tangent` is tan θ_s of the hull, 0 between floes.
double largest_ice_force(const Setup& setup, const Population& population, const dynamics::Contact& c,
                         double slope_tangent);

/// Sets the load of a hull in fast ice if the motion of both is prescribed; otherwise leaves the load unchanged. As the
/// area of the overlap grows by w per metre, the ice on a line of length w crushes, whatever the shape of the overlap
/// is. The force is limited to that of a line as long as the hull is wide, because neither body gives way.
void press_prescribed(const Setup& setup, const Step& step, const Population& population, HullContactLoad& load);

/// Sets the paid depth of a contact between bodies of prescribed motion. All of their overlap is paid, because nothing
/// can undo it. If the overlap's area has reached the paid area, the paid depth is set to the depth, so that no gap is
/// left: where ice was carved out, the depth does not show how much is paid.
void close_prescribed_gap(const Step& step, const dynamics::Bodies& bodies, dynamics::Contact& c);

}  // namespace polynya::simulation
