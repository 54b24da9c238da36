#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

// Signs and meetings of points and segments of doubles, decided exactly: in doubles where an error bound allows it
// [Shewchuk1997], else in error-free doubles, else in rationals. No result depends on which of them decided.
//
// REQUIRES, of all: coordinates are usable (is_usable), -ffp-contract=off, rounding to nearest. Where one is
// not finite the result is any. Points may coincide; rings need not be valid.
//
// Laws, which tests/geometry/laws_test.cpp holds for random and for nearly degenerate points:
//  1. Antisymmetry: cross_sign(a, b, c, d) = −cross_sign(c, d, a, b) = −cross_sign(b, a, c, d).
//  2. Rotation: orientation(a, b, c) = orientation(b, c, a) = −orientation(c, b, a).
//  3. Degeneracy: orientation(a, b, c) = 0 exactly where the three lie on a line, as where two are equal.
//  4. Symmetry: dot_sign(a, b, c, d) = dot_sign(c, d, a, b) = −dot_sign(b, a, c, d).
//  5. meet(a, b, c, d) has the kind of meet(c, d, a, b), meet(b, a, c, d) and meet(a, b, d, c).
//  6. A touch's point and an overlap's is an end of a segment, to the bit; only a crossing's is rounded.
//  7. area_sign of the reversed ring is −area_sign of the ring; its first vertex does not matter.
//  8. met_before(from, ·, ·) is a strict weak order; directions it does not order are equal as directions.

/// Is the point finite, and within what the products of areas and moments can express?
inline bool is_usable(Point p) {
  // Larger, the products of four coordinates and an edge count (second moments, crossings) overflow: signs
  // become those of NaN, and GMP is handed infinities, on which it ends the program. [m]
  constexpr double kLargest = 1e70;
  return std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest;
}

inline bool are_usable(std::span<const Point> points) {
  return std::all_of(points.begin(), points.end(), is_usable);
}

/// Sign of (b − a) × (d − c): +1 where the direction c→d is to the left of a→b. Laws 1, 3.
int cross_sign(Point a, Point b, Point c, Point d);

/// Sign of (b − a) × (c − a): +1 where a, b, c turn left. Laws 2, 3.
inline int orientation(Point a, Point b, Point c) {
  return cross_sign(a, b, a, c);
}

/// Sign of (b − a) · (d − c). Law 4.
int dot_sign(Point a, Point b, Point c, Point d);

/// Sign of a ring's signed area: +1 counter-clockwise; 0 of fewer than three vertices. Law 7.
int area_sign(const Ring& ring);

/// Is p within the closed segment? REQUIRES orientation(a, b, p) = 0.
inline bool in_span(Point a, Point b, Point p) {
  return std::min(a.x, b.x) <= p.x && p.x <= std::max(a.x, b.x) && std::min(a.y, b.y) <= p.y &&
         p.y <= std::max(a.y, b.y);
}

/// How two segments meet.
enum class Meeting {
  kNone,
  kTouch,    ///< in one point that is an end of at least one of them
  kCross,    ///< in one point inside both
  kOverlap,  ///< in more than a point
};
struct SegmentMeeting {
  Meeting kind = Meeting::kNone;
  Point at;  ///< the point of a touch (exact), a point of an overlap (exact), a crossing (rounded)
};
/// How the closed segments ab and cd meet. REQUIRES a ≠ b and c ≠ d. Laws 5, 6.
SegmentMeeting meet(Point a, Point b, Point c, Point d);

/// A direction, as two points that differ: exact although the difference of two doubles seldom is.
struct Ray {
  Point tail;
  Point head;
};
inline int cross_sign(const Ray& u, const Ray& v) {
  return cross_sign(u.tail, u.head, v.tail, v.head);
}

/// Turning counter-clockwise from `from`, is `a` met strictly before `b`? A direction equal to `from` is met
/// first. Law 8.
bool met_before(const Ray& from, const Ray& a, const Ray& b);

// The one test of a point in a ring: the parity of the edges that cross the ray from the point towards +x.
// Exact, also on the step's hot paths: two comparisons decide nearly all edges, and an exact orientation
// costs what the cross product in doubles did (docs/decisions/2026-11-23-spatial-searches.md).
//
// REQUIRES, of all: coordinates are usable. Rings may cross themselves and run either way.
//
// Laws, of which tests/geometry/predicates_test.cpp holds 9 and 10 for random rings:
//  9. Off the boundary, side_of_ring is +1 exactly where an odd number of the ring's edges has crosses_ray.
// 10. side_of_ring is the same of the ring reversed, and whichever vertex is its first.
// 11. side_of_ring is 0 on every edge and vertex, exactly: where orientation is 0 within an edge's span.
// 12. contains_strictly implies contains; they differ only on boundaries where holes lie inside the outer ring and
//     apart from each other.

/// Whether the edge from a to b crosses the ray from p towards +x. An end level with the point counts as
/// below it, so that along a closed chain each crossing counts once; a point on the edge is on either side.
inline bool crosses_ray(Point a, Point b, Point p) {
  if ((a.y > p.y) == (b.y > p.y)) return false;
  if (p.x < std::min(a.x, b.x)) return true;
  if (p.x > std::max(a.x, b.x)) return false;
  return (orientation(a, b, p) > 0) == (b.y > a.y);
}

/// −1 outside, 0 on the boundary, +1 inside the ring. REQUIRES a vertex at least. Laws 9 to 11.
int side_of_ring(const Ring& ring, Point p);

/// Is the point inside or on the boundary of the polygon (even-odd)? Of an empty polygon: no. Law 12.
bool contains(const Polygon& polygon, Point point);

/// Is the point in the interior of the polygon? REQUIRES a vertex at least of the outer ring and of each hole. Law 12.
bool contains_strictly(const Polygon& polygon, Point p);

}  // namespace polynya::geometry
