#pragma once

#include <algorithm>

#include "fracture/materials.hpp"

namespace polynya::fracture {

/// What decides that a floe splits.
enum class SplittingModel {
  kMichel,  ///< the paper's: j/τ_c of Eq. (5) against F_s of Eq. (4)
  kLefm,    ///< the true forces that open a crack against linear elastic fracture mechanics
  kNone,    ///< no floe splits
};

/// Force that splits a floe along a path of the given length [m], F_s = n L h σ_t [N].
/// Eq. (4) of [Sawamura2017] after [Michel1978]; n is the shape factor of the structure, 0.25 for a wedge.
inline double michel_splitting_force(const Ice& ice, double path_length, double shape_factor) {
  return shape_factor * path_length * ice.thickness * ice.tensile_strength;
}

/// The pair of opposite forces at its mouth that drives a crack from the edge across a plate of length L
/// along the crack and width W across it [m]: F_max = h K_IC min(0.187 √W, 0.2105 √L) [N]. The force rises
/// with the crack's length to this peak (at 0.05–0.175 L) and falls beyond: at it the plate splits. Fitted
/// within 2 % to finite elements of W/L from 0.25 to 3 (docs/theory.md, "Splitting"); K_IC 115–250 kPa √m
/// after [Bhat1988] (*recall*).
inline double lefm_splitting_force(const Ice& ice, double length, double width) {
  return ice.thickness * ice.fracture_toughness *
         std::min(0.187 * std::sqrt(width), 0.2105 * std::sqrt(length));
}

/// The least ice that a crack leaves on either side, else it would pare the floe's edge: such ice breaks off
/// by bending, in pieces of the size of l. By the characteristic length l = (D / ρ_w g)^¼, however Eq. (7) is
/// read: half of the least floe that breaks, a square of side l.
struct LeastPiece {
  double width_over_l = 0.5;  ///< mean width, area over the crack's length [-]
  double area_over_l2 = 0.5;  ///< [-]
  friend bool operator==(const LeastPiece&, const LeastPiece&) = default;
};

/// Whether a crack of that length [m] leaves a sliver, with the areas beside it [m²].
inline bool pares(const LeastPiece& least, double l, double length, double left_area, double right_area) {
  const double area = std::min(left_area, right_area);
  return area <= 0 || area < least.area_over_l2 * l * l || area < least.width_over_l * l * length;
}

}  // namespace polynya::fracture
