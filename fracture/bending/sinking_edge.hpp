#pragma once

#include "fracture/bending/edge_sections.hpp"

namespace polynya::fracture {

/// The weakest section of an edge that sinks, to second order: V presses the tip down, and the thrust with it, so that
/// the thrust's lever above a section becomes less, or less than nothing. What thrust alone would keep closed so breaks
/// too. `sinking` is w(0)/h per V/(σ_f h²), the tip's [-]; 0: weakest_section(). Without radial cracks a wide edge
/// bears what one that stays whole does.
SectionBreak weakest_section_of_sinking(const EdgeOpenings& openings, const EdgePush& push, double sinking,
                                        bool has_radial_cracks = true);

}  // namespace polynya::fracture
