#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Overlaps thinner than this are taken for the rounding of shared edges [m].
inline constexpr double kTouchingDepth = 1e-9;
/// Exactly found overlaps of less area than this likewise [m²].
inline constexpr double kTouchingArea = 1e-6;

struct OverlappingPair {
  std::size_t first = 0;  ///< the lower index
  std::size_t second = 0;
  double area = 0;  ///< [m²]
};

/// Which of the polygons share area, in the order of their indices; shared edges and corners are no overlap.
/// All must be valid. A grid of boxes finds the pairs (near linear for fields of ice), a separating edge
/// decides most, an exact cut the rest. Stops at `most`.
std::vector<OverlappingPair> find_overlapping_pairs(const std::vector<Polygon>& polygons, std::size_t most);

}  // namespace polynya::geometry
