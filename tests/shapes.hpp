#pragma once

#include <cmath>
#include <numbers>

#include "geometry/contact/near_boundaries.hpp"
#include "geometry/shape/polygon.hpp"

/// Polygons that tests are made of. Lengths in metres.
namespace polynya::shapes {

inline constexpr double kDegree = std::numbers::pi / 180;  ///< [rad]

inline geometry::Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

inline geometry::Polygon rectangle(double width, double height, geometry::Point centre = {}) {
  const double x = 0.5 * width, y = 0.5 * height;
  return rectangle(centre.x - x, centre.y - y, centre.x + x, centre.y + y);
}

inline geometry::Polygon square(geometry::Point low, double side) {
  return rectangle(low.x, low.y, low.x + side, low.y + side);
}

/// A square on its corner, the corner towards −x at `tip`.
inline geometry::Polygon diamond(geometry::Point tip, double half_diagonal) {
  const double d = half_diagonal;
  return {{tip, {tip.x + d, tip.y - d}, {tip.x + 2 * d, tip.y}, {tip.x + d, tip.y + d}}, {}};
}

/// Returns a regular polygon whose corners lie on a circle.
inline geometry::Polygon regular(int corners, double radius, geometry::Point centre = {}) {
  geometry::Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * std::numbers::pi * i / corners;
    polygon.outer.push_back({centre.x + radius * std::cos(angle), centre.y + radius * std::sin(angle)});
  }
  return polygon;
}

/// Converts the ring of a polygon to the ring of a hole, and back.
inline geometry::Ring reversed(const geometry::Ring& ring) {
  return {ring.rbegin(), ring.rend()};
}

}  // namespace polynya::shapes

namespace polynya::geometry {

/// A boundary that is ready for finding contacts.
inline Boundary make_boundary(const Polygon& polygon, const CircleRule& rule) {
  Boundary boundary = make_outline(polygon);
  make_ready(boundary, rule);
  return boundary;
}

}  // namespace polynya::geometry
