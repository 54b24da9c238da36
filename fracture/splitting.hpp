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
/// within 2 % to finite elements of W/L from 0.25 to 3 (docs/theory/splitting.md); K_IC 115–250 kPa √m
/// after [Bhat1988] (*recall*).
inline double lefm_splitting_force(const Ice& ice, double length, double width) {
  return ice.thickness * ice.fracture_toughness * std::min(0.187 * std::sqrt(width), 0.2105 * std::sqrt(length));
}

/// W/L down to which that was fitted. Cracks with less ice beside them do not run straight: they turn to the
/// free edge there.
inline constexpr double kLeastWidthOverLength = 0.25;

/// Whether a straight crack of that length [m] leaves a strip, with the areas beside it [m²]. W is twice the
/// mean width of its narrower side.
inline bool leaves_strip(double length, double left_area, double right_area) {
  return 2 * std::min(left_area, right_area) < kLeastWidthOverLength * length * length;
}

/// How a crack turns that begins beside a free edge, at a distance b from it: by the largest hoop stress, in
/// finite elements (tools/crack_plate.py, docs/theory/splitting.md). Two straight legs stand for its path:
/// end and area are right within 1 %, and nowhere is it more than 0.1 b off.
struct TurningCrack {
  double peak = 0.35;      ///< its length where the force is largest, of b [-]
  double straight = 0.63;  ///< the first leg, along the free edge, of b [-]
  double turn = 1.1817;    ///< of the second leg, towards the free edge: it ends 1.04 b on [rad]
  double most_on = 2.2;    ///< longest second leg, of b: twice that to an edge along the first [-]
  double force = 0.293;    ///< F_max / (h K_IC √b) [-]
};
inline constexpr TurningCrack kTurningCrack;

/// The pair of opposite forces at its mouth that drives a crack to the free edge at the distance b [m] beside
/// it, where the plate is much larger than b [N]. By the same finite elements, b/L from 0.02 to 0.25.
inline double turning_crack_force(const Ice& ice, double b) {
  return kTurningCrack.force * ice.thickness * ice.fracture_toughness * std::sqrt(b);
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
