#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// Polygons that belong together, and the polygons that replace them.
struct Joined {
  std::vector<std::size_t> members;         ///< indices of the polygons that were joined, ascending; one: a closed slit
  std::vector<geometry::Polygon> polygons;  ///< valid polygons that replace them, usually a single one
};

/// Joins polygons that were cut apart, for example by the edge of a map sheet or by longitude 180. Two polygons become
/// one if parts of their boundaries run along each other in opposite directions, within `reach` [m]. A slit in a
/// polygon narrower than `reach` is closed in the same way. A larger reach also joins floes with water between them.
///
/// `groups` has a number for each polygon, and only polygons with the same number are joined. The polygons are in house
/// notation (geometry::normalised), but may be invalid where a slit has no width. Corners within `reach` of each other
/// are merged, and so move by about `reach`; in a row of close corners all move to the first one. Polygons that are not
/// joined are not in the result, and neither is a set of polygons that enclose nothing when joined.
std::vector<Joined> join(const std::vector<geometry::Polygon>& polygons, const std::vector<std::size_t>& groups,
                         double reach);

}  // namespace polynya::io
