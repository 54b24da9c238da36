#pragma once

#include "geometry/exact/measures.hpp"

namespace polynya::simulation {

/// Speed of any point of a body, rim included, at which a run ends as a numerical failure [m/s]. A scene in which a
/// body starts at this speed is refused. No real ship or floe comes near it. A larger value detects a diverging run
/// later.
inline constexpr double kRunawaySpeed = 1e3;

/// Smallest area of a floe [m²]. Smaller ice in a scene is refused; smaller pieces of a fracture become brash. A
/// smaller value admits pieces whose shape is lost in rounding.
inline constexpr double kLeastFloeArea = 1e-6;

/// Returns true if ice with these measures can be a rigid body. It cannot if its area is below kLeastFloeArea, or if
/// its second moment is not positive because rounding has lost it, as in a sliver kilometres long.
inline bool can_be_floe(const geometry::Measures& measures) {
  return measures.area >= kLeastFloeArea && measures.second_moment > 0;
}

}  // namespace polynya::simulation
