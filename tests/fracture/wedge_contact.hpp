#pragma once

#include "fracture/crushing.hpp"

namespace polynya::fracture {

/// Returns A_c of a wedge of T = tan θ_wf + tan θ_wb at depth ξ [m²]: the contact line is T ξ, the overlap T ξ² / 2.
inline double crushed_area(double tangent_sum, double penetration, double thickness, double hull_angle) {
  const double width = tangent_sum * penetration;
  return crushed_overlap_area({width, penetration, 0.5 * width * penetration}, thickness, hull_angle);
}

}  // namespace polynya::fracture
