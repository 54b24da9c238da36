#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

// Operations on outlines that CGAL provides.

/// Returns the convex hull of points, counter-clockwise from the lowest one, without points on its edges. Exact.
Ring convex_hull(const std::vector<Point>& points);

/// Returns a valid polygon with vertices left out: each given vertex lies within `tolerance` [m] of the new boundary.
/// The vertices that are kept are among the given ones, and no ring crosses itself or another. Uses CGAL's polyline
/// simplification, which keeps the topology; returns the polygon unchanged if CGAL refuses it.
Polygon simplified(const Polygon& polygon, double tolerance);

/// A triangle as the numbers of its corners, counted over the outer ring and then the holes, in order.
using Triangle = std::array<std::uint32_t, 3>;

/// Returns the constrained Delaunay triangulation of a valid polygon with holes: counter-clockwise triangles without
/// new corners, decided exactly. Empty if the polygon cannot be triangulated in this way (rings that cross themselves,
/// or have all points on one line).
std::vector<Triangle> triangulate(const Polygon& polygon);

}  // namespace polynya::geometry
