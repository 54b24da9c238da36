#pragma once

#include <algorithm>
#include <cmath>

namespace polynya::simulation {

/// The overlap of two bodies in plan, as one contact measures it.
struct Overlap {
  double width = 0;  ///< dS/dξ at the waterline: length of the contact line [m]
  double depth = 0;  ///< ξ [m]
  double area = 0;   ///< S(ξ) [m²]
};

/// Crushed contact area from the overlap itself: A_c = [S(ξ) − S(ξ − h tan θ_s)] / sin θ_s, at a vertical
/// wall h dS/dξ. The general form of Eq. (2) of [Sawamura2017] for any contact shape. The overlap's history
/// is taken as the power law that its measures tell, S(ξ') = S (ξ'/ξ)^p with p = ξ (dS/dξ) / S: a wedge has p
/// = 2 and gives Eq. (2) exactly, a straight edge along the hull p = 1, where Eq. (2)'s tan θ_w would
/// diverge. p is held within [1, 3].
inline double crushed_overlap_area(const Overlap& overlap, double thickness, double hull_angle) {
  if (overlap.area <= 0 || overlap.depth <= 0) return 0;
  const double p = std::clamp(overlap.depth * overlap.width / overlap.area, 1.0, 3.0);
  const double reach = thickness * std::tan(hull_angle);
  const double sine = std::sin(hull_angle);
  if (sine == 0) return overlap.area * p / overlap.depth * thickness;
  if (reach >= overlap.depth) return overlap.area / sine;
  return overlap.area / sine * -std::expm1(p * std::log1p(-reach / overlap.depth));
}

}  // namespace polynya::simulation
