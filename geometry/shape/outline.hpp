#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

// What CGAL makes of outlines.

/// The convex hull of points, counter-clockwise from the lowest one, without points on its edges. Exact, by CGAL.
Ring convex_hull(const std::vector<Point>& points);

/// A valid polygon with vertices left out: each one given lies within `tolerance` [m] of the boundary that is
/// left. The vertices kept are among those given, and no ring crosses itself or another. By CGAL's polyline
/// simplification, which keeps the topology; the polygon as it is where CGAL refuses it.
Polygon simplified(const Polygon& polygon, double tolerance);

/// Triangles by their corners' numbers, counted over the outer ring and then the holes, in order.
using Triangle = std::array<std::uint32_t, 3>;

/// The constrained Delaunay triangulation of a valid polygon with holes, counter-clockwise triangles, no new
/// corners. Decided exactly. Empty where the polygon is not valid enough to be triangulated so (rings that
/// cross themselves, or have all their points on a line).
std::vector<Triangle> triangulate(const Polygon& polygon);

}  // namespace polynya::geometry
