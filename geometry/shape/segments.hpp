#pragma once

#include <algorithm>

#include "geometry/shape/point.hpp"

namespace polynya::geometry {

// Two segments in doubles, for decisions within a margin. Where the sign itself decides, use geometry/exact.

/// Returns true if each segment has its ends on both sides of the other's line, or on it: the segments cross or touch.
/// REQUIRES that they are not on one line, where the result is always true; boxes that overlap exclude segments on one
/// line that are apart.
constexpr bool are_across(Point a0, Point a1, Point b0, Point b1) {
  const double b_sides = cross(a1 - a0, b0 - a0) * cross(a1 - a0, b1 - a0);
  const double a_sides = cross(b1 - b0, a0 - b0) * cross(b1 - b0, a1 - b0);
  return b_sides <= 0 && a_sides <= 0;
}

/// Returns true if the segments cross; false for segments on one line. For segments that only touch the result may be
/// either.
constexpr bool cross_each_other(Point a0, Point a1, Point b0, Point b1) {
  const auto is_left = [](Point from, Point to, Point p) { return cross(to - from, p - from) > 0; };
  return is_left(a0, a1, b0) != is_left(a0, a1, b1) && is_left(b0, b1, a0) != is_left(b0, b1, a1);
}

/// Returns the square of the smallest distance of an end of one segment to the other [m²]. It is the distance of the
/// segments unless they cross.
constexpr double squared_distance_of_ends(Point a0, Point a1, Point b0, Point b1) {
  const auto to_segment = [](Point p, Point from, Point to) {
    return squared_length(nearest_on_segment(from, to, p) - p);
  };
  return std::min({to_segment(a0, b0, b1), to_segment(a1, b0, b1), to_segment(b0, a0, a1), to_segment(b1, a0, a1)});
}

}  // namespace polynya::geometry
