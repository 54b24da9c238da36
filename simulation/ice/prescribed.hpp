#pragma once

#include "simulation/ship/hull_contact_load.hpp"

namespace polynya::simulation {

/// The longest contact line that two bodies can have across the contact's normal: the extent of the smaller one [m].
double longest_line(const dynamics::Bodies& bodies, const dynamics::Contact& c);

/// The most that ice can bear along that line, σ_c h W (1 + μ tan θ_s) [N].
double most_that_ice_bears(const Setup& setup, const Population& population, const dynamics::Contact& c,
                           double slope_tangent);

/// Enters the load of a hull in fast ice where the motion of both is prescribed: as the overlap's area grows
/// by w per metre, so much ice crushes, whatever the overlap has become; never more than a line as long as
/// the hull is wide bears, since nothing gives way there. Else the load is as it was.
void press_prescribed(const Setup& setup, const Step& step, const Population& population, HullContactLoad& load);

/// Enters the paid depth of a contact of prescribed bodies. All of its overlap is paid, since nothing can undo it.
/// There is no gap where the overlap is as large as what is paid: its depth does not show it where ice was carved out.
void close_prescribed_gap(const Step& step, const dynamics::Bodies& bodies, dynamics::Contact& c);

}  // namespace polynya::simulation
