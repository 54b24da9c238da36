#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

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
/// finite elements (studies/benches/crack_plate.py, docs/theory/splitting.md). Two straight legs stand for its path:
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
inline bool leaves_sliver(const LeastPiece& least, double l, double length, double left_area, double right_area) {
  const double area = std::min(left_area, right_area);
  return area <= 0 || area < least.area_over_l2 * l * l || area < least.width_over_l * l * length;
}

// What opens a crack: the pushes of the bodies beside it.

/// A face of a body that presses on ice, in plan.
struct Face {
  geometry::Point middle;   ///< [m]
  geometry::Vector normal;  ///< unit, into the ice
  double slip = 0;          ///< of the body relative to the ice, along perpendicular(normal) [m/s]
  double leaving = 0;       ///< speed at which a stern's face moves away from the ice; 0 of others [m/s]
};

/// What a face does to the ice.
struct Push {
  geometry::Point at;      ///< [m]
  geometry::Vector force;  ///< [N]
};

/// Slip from which friction is all there: below it grows in proportion, so that ice at rest between two faces
/// has one solution [m/s].
inline constexpr double kFullSlip = 5e-3;

/// The force of a wedge on ice, resolved into those of its two faces: each presses along its normal and drags
/// the ice along with μ of that, F = Σ N_i (n_i + μ t_i). None where one of them would have to pull, or is a
/// stern's that leaves the ice faster than kFullSlip: then the body bears on the other alone. For a stem of
/// half-angle α that sails ahead each face pushes sideways with F (1 − μ tan α) / [2 (tan α + μ)].
std::optional<std::array<Push, 2>> wedge_pushes(geometry::Vector force, const std::array<Face, 2>& faces,
                                                double friction);

/// What opens a crack.
struct Opening {
  double left = 0;   ///< by which the ice on its left is pushed to the left [N]
  double right = 0;  ///< likewise [N]

  /// The pair of opposite forces in it; what one side has more moves the floe [N].
  double force() const;
};

/// Of the pushes on either side of a crack from `mouth` along the unit `direction`. What pushes along the
/// crack is left out: against inertia it closes the mouth, 27–64 times more weakly than the same force across
/// opens it.
Opening opening_of(std::span<const Push> pushes, geometry::Point mouth, geometry::Vector direction);

}  // namespace polynya::fracture
