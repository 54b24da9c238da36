#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Is the point finite, and within what the products of areas and moments can express?
inline bool is_usable(Point p) {
  constexpr double kLargest = 1e70;  // [m]
  return std::abs(p.x) <= kLargest && std::abs(p.y) <= kLargest;
}

inline bool are_usable(std::span<const Point> points) {
  return std::all_of(points.begin(), points.end(), is_usable);
}

/// Sign of (b − a) × (d − c), exactly: +1 where the direction c→d is to the left of a→b.
/// Decided in doubles where an error bound allows it, else in error-free doubles, else in rationals.
int cross_sign(Point a, Point b, Point c, Point d);

/// Sign of (b − a) × (c − a), exactly: +1 where a, b, c turn left.
inline int orientation(Point a, Point b, Point c) {
  return cross_sign(a, b, a, c);
}

/// Sign of (b − a) · (d − c), exactly.
int dot_sign(Point a, Point b, Point c, Point d);

/// Sign of a ring's signed area, exactly: +1 counter-clockwise.
int area_sign(const Ring& ring);

/// Is p, known to be on the line through a and b, within the closed segment?
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
SegmentMeeting meet(Point a, Point b, Point c, Point d);

/// Where two crossing segments cross, in plain doubles: for messages only.
Point approximate_crossing(Point a, Point b, Point c, Point d);

/// A direction, as two points: exact although the difference of two doubles seldom is.
struct Ray {
  Point tail;
  Point head;
};
inline int cross_sign(const Ray& u, const Ray& v) {
  return cross_sign(u.tail, u.head, v.tail, v.head);
}

/// Turning counter-clockwise from `from`, is `a` met strictly before `b`? A direction equal to `from` is met
/// first.
bool met_before(const Ray& from, const Ray& a, const Ray& b);

/// −1 outside, 0 on the boundary, +1 inside the ring; exact.
int side_of_ring(const Ring& ring, Point p);

/// Is the point in the interior of the polygon? Exact.
bool contains_strictly(const Polygon& polygon, Point p);

}  // namespace polynya::geometry
