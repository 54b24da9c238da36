#pragma once

#include <array>
#include <optional>
#include <span>

#include "geometry/shape/point.hpp"

namespace polynya::fracture {

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
