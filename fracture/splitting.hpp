#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::fracture {

/// The rules that decide whether a floe splits.
enum class SplittingModel {
  kMichel,  ///< the paper's rule: j/τ_c of Eq. (5) against F_s of Eq. (4)
  kLefm,    ///< the true forces that open a crack, against linear elastic fracture mechanics
  kNone,    ///< no floe splits
};

/// Returns the force that splits a floe along a path of the given length [m], F_s = n L h σ_t [N]. Eq. (4) of
/// [Sawamura2017] after [Michel1978]; n is the shape factor of the structure, 0.25 for a wedge.
inline double michel_splitting_force(const Ice& ice, double path_length, double shape_factor) {
  return shape_factor * path_length * ice.thickness * ice.tensile_strength;
}

/// Returns the force F_max = h K_IC min(0.187 √W, 0.2105 √L) at which a crack runs [N]. It is one of a pair of opposite
/// forces at the mouth of a crack that starts at the edge of a plate with the length L along the crack and the width W
/// across it [m]. The force rises with the length of the crack to this peak (at 0.05–0.175 L) and then falls: at the
/// peak the plate splits. Fitted within 2 % to finite elements for W/L from 0.25 to 3 (docs/theory/splitting.md); K_IC
/// is 115–250 kPa √m after [Bhat1988] (*recall*).
inline double lefm_splitting_force(const Ice& ice, double length, double width) {
  return ice.thickness * ice.fracture_toughness * std::min(0.187 * std::sqrt(width), 0.2105 * std::sqrt(length));
}

/// Smallest W/L of that fit. Cracks with less ice beside them do not run straight: they turn to the free edge there.
inline constexpr double kLeastWidthOverLength = 0.25;

/// Returns true if a straight crack of this length [m] leaves a strip, given the areas on both sides [m²]. W is twice
/// the mean width of its narrower side.
inline bool leaves_strip(double length, double left_area, double right_area) {
  return 2 * std::min(left_area, right_area) < kLeastWidthOverLength * length * length;
}

/// The path of a crack that begins at a distance b from a free edge. It turns by the largest hoop stress, as found in
/// finite elements (studies/benches/crack_plate.py, docs/theory/splitting.md). Two straight legs approximate it: end
/// and area are right within 1 %, and the path deviates by at most 0.1 b.
struct TurningCrack {
  double peak = 0.35;      ///< length of the crack at which the force is largest, over b [-]
  double straight = 0.63;  ///< first leg, along the free edge, over b [-]
  double turn = 1.1817;    ///< from the first leg to the second, which ends 1.04 b from the mouth along the edge [rad]
  double most_on = 2.2;    ///< longest second leg, over b: twice its length to an edge along the first leg [-]
  double force = 0.293;    ///< F_max / (h K_IC √b) [-]
};
inline constexpr TurningCrack kTurningCrack;

/// Returns the force that drives a crack to a free edge at the distance b [m] beside it, in a plate that is much larger
/// than b [N]. It is one of a pair of opposite forces at the mouth. From the same finite elements, for b/L from 0.02 to
/// 0.25.
inline double turning_crack_force(const Ice& ice, double b) {
  return kTurningCrack.force * ice.thickness * ice.fracture_toughness * std::sqrt(b);
}

/// The smallest piece of ice that a crack may leave on either side. Without this limit cracks would cut away the floe's
/// edge; narrower ice breaks off by bending, in pieces of the size of l. The characteristic length here is l = (D / ρ_w
/// g)^¼, whatever the reading of Eq. (7). The defaults are half of the smallest floe that breaks, a square of side l.
struct LeastPiece {
  double width_over_l = 0.5;  ///< mean width, area over the crack's length [-]
  double area_over_l2 = 0.5;  ///< [-]
  friend bool operator==(const LeastPiece&, const LeastPiece&) = default;
};

/// Returns true if a crack of this length [m] leaves a sliver, given the areas on both sides [m²].
inline bool leaves_sliver(const LeastPiece& least, double l, double length, double left_area, double right_area) {
  const double area = std::min(left_area, right_area);
  return area <= 0 || area < least.area_over_l2 * l * l || area < least.width_over_l * l * length;
}

// The forces that open a crack: pushes of the bodies beside it.

/// A face of a body that presses on ice, in plan.
struct Face {
  geometry::Point middle;   ///< [m]
  geometry::Vector normal;  ///< unit vector into the ice
  double slip = 0;          ///< speed of the body relative to the ice along perpendicular(normal) [m/s]
  double leaving = 0;       ///< speed at which a stern's face moves away from the ice; 0 for other faces [m/s]
};

/// The force of a face on the ice.
struct Push {
  geometry::Point at;      ///< [m]
  geometry::Vector force;  ///< [N]
};

/// Slip speed from which friction acts fully [m/s]. Below it friction grows in proportion, so that ice at rest between
/// two faces has one solution.
inline constexpr double kFullSlip = 5e-3;

/// Resolves the force of a wedge on ice into the forces of its two faces. Each face presses along its normal and drags
/// the ice by friction: F = Σ N_i (n_i + μ t_i). Returns nullopt, and the caller counts the force as one push, if one
/// face would pull, if one is a stern's face that moves away from the ice faster than kFullSlip, or if both are
/// parallel. For a stem of half-angle α that moves ahead, each face pushes sideways with F (1 − μ tan α) / [2 (tan α +
/// μ)].
std::optional<std::array<Push, 2>> wedge_pushes(geometry::Vector force, const std::array<Face, 2>& faces,
                                                double friction);

/// The forces that open a crack.
struct Opening {
  double left = 0;   ///< by which the ice on the left is pushed to the left [N]
  double right = 0;  ///< by which the ice on the right is pushed to the right [N]

  /// Returns the smaller of the two; the excess of the other one moves the floe [N].
  double force() const;
};

/// Returns the opening of a crack from `mouth` along the unit vector `direction` by the pushes on both sides. Pushes
/// along the crack are left out: against inertia they close the mouth, 27–64 times more weakly than the same force
/// across opens it.
Opening opening_of(std::span<const Push> pushes, geometry::Point mouth, geometry::Vector direction);

}  // namespace polynya::fracture
