#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

// Signs and intersections of points and segments of doubles, decided exactly: in doubles if an error bound allows it
// [Shewchuk1997], otherwise in error-free doubles, otherwise in rationals. No result depends on which of them decides.
//
// REQUIRES, for all functions: coordinates are usable (is_usable), -ffp-contract=off, rounding to nearest. The result
// is arbitrary if a coordinate is not finite. Points may coincide; rings need not be valid.
//
// Laws, which tests/geometry/laws_test.cpp checks for random and for nearly degenerate points:
//  1. Antisymmetry: cross_sign(a, b, c, d) = −cross_sign(c, d, a, b) = −cross_sign(b, a, c, d).
//  2. Rotation: orientation(a, b, c) = orientation(b, c, a) = −orientation(c, b, a).
//  3. Degeneracy: orientation(a, b, c) = 0 exactly if the three lie on a line, for example if two are equal.
//  4. Symmetry: dot_sign(a, b, c, d) = dot_sign(c, d, a, b) = −dot_sign(b, a, c, d).
//  5. meet(a, b, c, d) has the kind of meet(c, d, a, b), meet(b, a, c, d) and meet(a, b, d, c).
//  6. A touch's point and an overlap's is an end of a segment, to the bit; only a crossing's is rounded.
//  7. area_sign of the reversed ring is −area_sign of the ring; its first vertex does not matter.
//  8. met_before(from, ·, ·) is a strict weak order; directions it does not order are equal as directions.

/// Returns true if the point is finite and within the range that products of areas and moments can represent.
inline bool is_usable(Point p) {
  // If it were larger, products of four coordinates and an edge count (second moments, crossings) would overflow. Signs
  // would be those of NaN, and GMP would receive infinities, on which it ends the program. [m]
  constexpr double kLargest = 1e70;
  return std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest;
}

inline bool are_usable(std::span<const Point> points) {
  return std::all_of(points.begin(), points.end(), is_usable);
}

/// Returns the sign of (b − a) × (d − c): +1 if the direction c→d is to the left of a→b. Laws 1, 3.
int cross_sign(Point a, Point b, Point c, Point d);

/// Returns the sign of (b − a) × (c − a): +1 if a, b, c turn left. Laws 2, 3.
inline int orientation(Point a, Point b, Point c) {
  return cross_sign(a, b, a, c);
}

/// Returns the sign of (b − a) · (d − c). Law 4.
int dot_sign(Point a, Point b, Point c, Point d);

/// Returns the sign of a ring's signed area: +1 if counter-clockwise; 0 for fewer than three vertices. Law 7.
int area_sign(const Ring& ring);

/// Returns true if p lies within the closed segment. REQUIRES orientation(a, b, p) = 0.
inline bool in_span(Point a, Point b, Point p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// The ways in which two segments intersect.
enum class Meeting {
  kNone,
  kTouch,    ///< in one point, which is an end of at least one of them
  kCross,    ///< in one point, which is inside both
  kOverlap,  ///< in more than one point
};
struct SegmentMeeting {
  Meeting kind = Meeting::kNone;
  Point at;  ///< the point of a touch (exact), a point of an overlap (exact), or the crossing (rounded)
};
/// Returns how the closed segments ab and cd intersect. REQUIRES a ≠ b and c ≠ d. Laws 5, 6.
SegmentMeeting meet(Point a, Point b, Point c, Point d);

/// A direction, given by two different points: it is exact, although the difference of two doubles rarely is.
struct Ray {
  Point tail;
  Point head;
};
inline int cross_sign(const Ray& u, const Ray& v) {
  return cross_sign(u.tail, u.head, v.tail, v.head);
}

/// Returns true if, turning counter-clockwise from `from`, `a` is reached strictly before `b`. A direction equal to
/// `from` is reached first. Law 8.
bool met_before(const Ray& from, const Ray& a, const Ray& b);

// The one test of a point in a ring: the parity of the edges that cross the ray from the point towards +x. It is exact,
// also in the frequent calls of a step: two comparisons decide nearly all edges, and an exact orientation costs as much
// as the cross product in doubles did (docs/decisions/2026-11-23-spatial-searches.md).
//
// REQUIRES, for all functions: coordinates are usable. Rings may cross themselves and run either way.
//
// Laws; tests/geometry/predicates_test.cpp checks 9 and 10 for random rings:
//  9. Off the boundary, side_of_ring is +1 exactly if crosses_ray is true for an odd number of the ring's edges.
// 10. side_of_ring does not change if the ring is reversed, or starts at another vertex.
// 11. side_of_ring is 0 on every edge and vertex, exactly: if orientation is 0 within an edge's span.
// 12. contains_strictly implies contains; they differ only on boundaries if the holes lie inside the outer ring and
//     apart from each other.

/// Returns true if the edge from a to b crosses the ray from p towards +x. An end level with the point counts as below
/// it, so that each crossing counts once along a closed chain. A point on the edge may be on either side.
inline bool crosses_ray(Point a, Point b, Point p) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  if (p.x < std::min(a.x, b.x)) return true;
  if (p.x > std::max(a.x, b.x)) return false;
  return (orientation(a, b, p) > 0) == (b.y > a.y);
}

/// Returns −1 outside, 0 on the boundary, +1 inside the ring. REQUIRES at least one vertex. Laws 9 to 11.
int side_of_ring(const Ring& ring, Point p);

/// Returns true if the point is inside or on the boundary of the polygon (even-odd); false if it is empty. Law 12.
bool contains(const Polygon& polygon, Point point);

/// Returns true if the point is in the interior of the polygon. REQUIRES at least one vertex of the outer ring and of
/// each hole. Law 12.
bool contains_strictly(const Polygon& polygon, Point p);

}  // namespace polynya::geometry
