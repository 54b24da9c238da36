#pragma once

#include <algorithm>

namespace polynya::dynamics {

// Ice under a hull: the force that the buoyancy of broken ice and its friction along the hull take from the ship, piece
// by piece. The resistance of a hull that is covered with ice is R_s of [Lindqvist1989]. Here each piece contributes
// its share of R_s while the hull passes over it.

/// The main dimensions of a hull.
struct HullForm {
  double length = 0;          ///< L of the waterline [m]
  double beam = 0;            ///< B [m]
  double draught = 0;         ///< T [m]
  double stem_angle = 0;      ///< φ, of the stem from the horizontal [rad]
  double entrance_angle = 0;  ///< α, of the waterline from the centreline [rad]
};

/// The path of ice under a hull, as a function of the distance s that the ship has moved since the piece went under.
struct SubmersionPath {
  double rise = 0;     ///< z̄ = T (B + T) / (B + 2 T): mean depth to which the ice is pressed down [m]
  double bow = 0;      ///< s_b = T / tan φ: distance over which it is pressed down [m]
  double sliding = 0;  ///< s̄: distance over which it slides along the hull, from the equation of R_s [m]

  /// Returns the part of z̄ between two values of s [m].
  double risen_over(double from, double to) const { return bow > 0 ? rise / bow * part_of(bow, from, to) : 0; }
  /// Returns the part of s̄ between two values of s [m].
  double slid_over(double from, double to) const { return part_of(sliding, from, to); }
  /// Returns the part of s̄ that lies behind the bow between two values of s [m].
  double slid_behind_bow_over(double from, double to) const {
    return std::max(0.0, part_of(sliding, from, to) - part_of(std::min(bow, sliding), from, to));
  }

 private:
  /// Returns the length of the part of [0, length] that lies between two values of s [m].
  static double part_of(double length, double from, double to) {
    return std::clamp(to, 0.0, length) - std::clamp(from, 0.0, length);
  }
};

/// Returns the path with s̄ = 0.7 L − T/tan φ − B/(4 tan α) + T cos φ cos ψ √(1/sin² φ + 1/tan² α), ψ = atan(tan φ /
/// sin α), but not below 0. [Lindqvist1989] (recall: read in public code).
SubmersionPath submersion_path(const HullForm& hull);

/// Returns Lindqvist's factor of speed on R_s, 1 + 9.4 v / √(g L), for v ≥ 0 [m/s].
double submersion_speed_factor(double speed, double length);

}  // namespace polynya::dynamics
