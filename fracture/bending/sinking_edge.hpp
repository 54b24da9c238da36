#pragma once

#include "fracture/bending/edge_sections.hpp"

namespace polynya::fracture {

/// Returns the weakest section of an edge that sinks, to second order. V presses the tip down, and the thrust with it,
/// so that the thrust's lever above a section becomes smaller or negative. Ice that the thrust alone would keep closed
/// therefore breaks too. `sinking` is w(0)/h of the tip per V/(σ_f h²) [-]; 0 gives weakest_section(). Without radial
/// cracks a wide edge carries the force of one that stays whole.
SectionBreak weakest_section_of_sinking(const EdgeOpenings& openings, const EdgePush& push, double sinking,
                                        bool has_radial_cracks = true);

}  // namespace polynya::fracture
