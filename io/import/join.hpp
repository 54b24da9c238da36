#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// Several polygons that were joined.
struct Joined {
  std::vector<std::size_t> members;         ///< indices of the polygons, ascending
  std::vector<geometry::Polygon> polygons;  ///< polygons that replace them; fewer than before
};

/// Joins polygons that were cut apart. Two polygons become one if their boundaries run in opposite directions within
/// `reach` [m] of each other. A slit in a polygon narrower than `reach` is closed. Only polygons of the same group are
/// joined. The polygons are in house notation (geometry::normalised), which a slit of no width may make invalid.
/// Corners of joined polygons move by at most `reach`. Polygons that are not joined are not in the result.
std::vector<Joined> join(const std::vector<geometry::Polygon>& polygons, const std::vector<std::size_t>& groups,
                         double reach);

}  // namespace polynya::io
