#pragma once

#include <utility>
#include <vector>

#include "geometry/shape/pose.hpp"

namespace polynya::geometry {

/// A closed boundary: its vertices in order [m]; the first one is not repeated at the end.
using Ring = std::vector<Point>;

/// A region with holes. In a valid polygon (validity.hpp) the outer ring runs counter-clockwise, holes
/// clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

/// The shape of a floe at rest in its body frame. Every double is a rational number: these coordinates are exact.
struct Shape {
  Polygon polygon;
  /// Set by the cuts on their pieces, which are valid, so that the next cut does not validate them again. Clear it
  /// after editing `polygon`.
  bool known_valid = false;
};

inline Box bounding_box(const Ring& ring) {
  Box box{ring.front(), ring.front()};
  for (const Point p : ring) extend(box, p);
  return box;
}

/// Calls use(from, to) for each edge of a closed chain of points, in order.
template <class Points, class Use>
void for_ring_edges(const Points& ring, Use use) {
  for (std::size_t i = 0; i < ring.size(); ++i) use(ring[i], ring[i + 1 < ring.size() ? i + 1 : 0]);
}

/// Returns an outline of frame b, in frame a.
inline Ring transform(const Pose& a_from_b, Ring ring) {
  for (Point& p : ring) p = transform(a_from_b, p);
  return ring;
}
inline Polygon transform(const Pose& a_from_b, Polygon polygon) {
  polygon.outer = transform(a_from_b, std::move(polygon.outer));
  for (Ring& hole : polygon.holes) hole = transform(a_from_b, std::move(hole));
  return polygon;
}

inline std::size_t vertex_count(const Polygon& polygon) {
  std::size_t count = polygon.outer.size();
  for (const Ring& hole : polygon.holes) count += hole.size();
  return count;
}

}  // namespace polynya::geometry
