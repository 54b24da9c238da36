#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// Polygons that have become fewer.
struct Joined {
  std::vector<std::size_t> members;         ///< the polygons, by their indices, ascending
  std::vector<geometry::Polygon> polygons;  ///< in their place
};

/// Joins polygons that were cut apart: those whose boundaries run along each other, within `reach` [m] and in opposite
/// directions, become one, and a slit in a polygon narrower than that is closed. Only polygons of the same group are
/// joined. The polygons are in house notation (geometry::normalised), which a slit of no width may make invalid.
/// Corners of polygons that are joined move by at most `reach`; polygons that are not joined are not in the result.
std::vector<Joined> join(const std::vector<geometry::Polygon>& polygons, const std::vector<std::size_t>& groups,
                         double reach);

}  // namespace polynya::io
