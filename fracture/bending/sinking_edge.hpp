#pragma once

#include "fracture/bending/edge_sections.hpp"

namespace polynya::fracture {

/// Returns the weakest section of an edge, with the sinking of its tip taken into account (second order). V presses the
/// tip down, and the line of the thrust sinks with it, so the thrust's lever above a section becomes smaller or
/// negative. Therefore ice also breaks that the thrust alone would keep under compression. `sinking` is the deflection
/// w(0)/h of the tip per V/(σ_f h²) [-]; with 0 the result is weakest_section(). With `has_radial_cracks` false, a wide
/// edge carries the force of an edge without cracks.
SectionBreak weakest_section_of_sinking(const EdgeOpenings& openings, const EdgeLoad& load, double sinking,
                                        bool has_radial_cracks = true);

}  // namespace polynya::fracture
