#pragma once

#include "geometry/exact/measures.hpp"

namespace polynya::simulation {

/// A run whose bodies reach this speed, rims included, ends as a numerical failure; a scene that starts so is
/// refused [m/s].
inline constexpr double kRunawaySpeed = 1e3;

/// The least area of a floe [m²]: smaller ice of a scene is refused, of a fracture it is brash.
inline constexpr double kLeastFloeArea = 1e-6;

/// Whether ice of these measures can be a rigid body: not where its area is too small, or where its second
/// moment is lost in rounding, as of a sliver kilometres long.
inline bool can_be_floe(const geometry::Measures& measures) {
  return measures.area >= kLeastFloeArea && measures.second_moment > 0;
}

}  // namespace polynya::simulation
