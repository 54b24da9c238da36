#pragma once

#include <algorithm>

namespace polynya::dynamics {

// Ice under a hull: what the buoyancy of broken ice and its friction along the hull take from the ship, piece
// by piece. The resistance of a hull covered with ice is R_s of [Lindqvist1989]; here each piece pays its
// share of it while the hull passes over it.

/// A hull's main dimensions.
struct HullForm {
  double length = 0;          ///< L of the waterline [m]
  double beam = 0;            ///< B [m]
  double draught = 0;         ///< T [m]
  double stem_angle = 0;      ///< φ, of the stem from the horizontal [rad]
  double entrance_angle = 0;  ///< α, of the waterline from the centreline [rad]
};

/// The way of ice under a hull, by how far the ship has come since the piece went under, s.
struct SubmersionPath {
  double rise = 0;     ///< z̄ = T (B + T) / (B + 2 T): mean depth it is pressed down to [m]
  double bow = 0;      ///< s_b = T / tan φ: over which it is pressed down [m]
  double sliding = 0;  ///< s̄, over which it slides along the hull, Eq. of R_s [m]

  /// Of z̄, between two values of s [m].
  double risen_over(double from, double to) const { return bow > 0 ? rise / bow * part_of(bow, from, to) : 0; }
  /// Of s̄, likewise [m].
  double slid_over(double from, double to) const { return part_of(sliding, from, to); }

 private:
  /// How much of the way [0, length] lies between two values of s [m].
  static double part_of(double length, double from, double to) {
    return std::clamp(to, 0.0, length) - std::clamp(from, 0.0, length);
  }
};

/// s̄ = .7 L − T/tan φ − B/(4 tan α) + T cos φ cos ψ √(1/sin² φ + 1/tan² α), ψ = atan(tan φ / sin α).
/// [Lindqvist1989] (recall: read in public code). Not below 0.
SubmersionPath submersion_path(const HullForm& hull);

/// Lindqvist's factor of speed on R_s, 1 + 9.4 v / √(g L), v ≥ 0 [m/s].
double submersion_speed_factor(double speed, double length);

}  // namespace polynya::dynamics
