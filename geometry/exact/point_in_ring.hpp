#pragma once

#include <algorithm>

#include "geometry/exact/internal/predicates.hpp"

namespace polynya::geometry {

// The one test of a point in a ring: the parity of the edges that cross the ray from the point towards +x.
// Exact, also on the step's hot paths: two comparisons decide nearly all edges, and an exact orientation
// costs what the cross product in doubles did (docs/decisions/2026-11-23-spatial-searches.md).
//
// REQUIRES, of all: coordinates are usable (is_usable, predicates.hpp). Rings may cross themselves and run either way.
//
// Laws, of which tests/geometry/predicates_test.cpp holds 1 and 2 for random rings:
//  1. Off the boundary, side_of_ring is +1 exactly where an odd number of the ring's edges has crosses_ray.
//  2. side_of_ring is the same of the ring reversed, and whichever vertex is its first.
//  3. side_of_ring is 0 on every edge and vertex, exactly: where orientation is 0 within an edge's span.
//  4. contains_strictly implies contains; they differ only on boundaries where holes lie inside the outer ring and
//     apart from each other.

/// Whether the edge from a to b crosses the ray from p towards +x. An end level with the point counts as
/// below it, so that along a closed chain each crossing counts once; a point on the edge is on either side.
inline bool crosses_ray(Point a, Point b, Point p) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  if (p.x < std::min(a.x, b.x)) return true;
  if (p.x > std::max(a.x, b.x)) return false;
  return (orientation(a, b, p) > 0) == (b.y > a.y);
}

/// −1 outside, 0 on the boundary, +1 inside the ring. REQUIRES a vertex at least. Laws 1 to 3.
int side_of_ring(const Ring& ring, Point p);

/// Is the point inside or on the boundary of the polygon (even-odd)? Of an empty polygon: no. Law 4.
bool contains(const Polygon& polygon, Point point);

/// Is the point in the interior of the polygon? REQUIRES a vertex at least of the outer ring and of each hole. Law 4.
bool contains_strictly(const Polygon& polygon, Point p);

}  // namespace polynya::geometry
