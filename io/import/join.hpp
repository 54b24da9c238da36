#pragma once

#include <cstddef>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// Polygons that belong together, and the polygons that replace them.
struct Joined {
  /// Indices in the argument `polygons` of join() of those that were joined, ascending. A single index means that a
  /// slit in this polygon was closed.
  std::vector<std::size_t> members;
  std::vector<geometry::Polygon> polygons;  ///< valid polygons that replace them, at least one, usually a single one
};

/// Joins polygons that were cut apart, for example by the edge of a map sheet or by longitude 180. Two polygons become
/// one if parts of their boundaries run along each other in opposite directions, within `reach` [m]. A slit in a
/// polygon narrower than `reach` is closed in the same way. A larger reach also joins floes with water between them;
/// with a smaller one, parts whose edges do not match exactly stay apart.
///
/// `groups` has a number for each polygon, and only polygons with the same number are joined. The polygons have
/// coordinates in metres in one plane. They are in house notation (geometry::normalised), but may be invalid where a
/// slit has no width; an empty polygon is left out. Corners of a group within `reach` of each other are merged, and so
/// move by about `reach`; in a row of close corners all move to the first one. This also changes the corners of joined
/// polygons away from the common edge. Polygons that are not joined are not in the result, so that the caller keeps
/// them as they are. Neither is a set of polygons that enclose nothing when joined.
std::vector<Joined> join(const std::vector<geometry::Polygon>& polygons, const std::vector<std::size_t>& groups,
                         double reach);

}  // namespace polynya::io
