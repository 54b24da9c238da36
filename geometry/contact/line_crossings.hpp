#pragma once

#include <cstdint>
#include <vector>

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// Where a line crosses a boundary.
struct LineCrossing {
  double at = 0;  ///< along the line [m]
  std::uint32_t edge = 0;
};

/// The crossings of the line through a point with a boundary, in order: an even number, since every ring is
/// closed. In doubles; tests only edges near the line where the boundary is ready.
std::vector<LineCrossing> crossings_of_line(const Boundary& boundary, Point point, Vector direction);

}  // namespace polynya::geometry
