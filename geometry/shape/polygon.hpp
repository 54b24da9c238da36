#pragma once

#include <vector>

#include "geometry/shape/box.hpp"

namespace polynya::geometry {

/// A closed boundary: its vertices in order [m], the first one not repeated at the end.
using Ring = std::vector<Point>;

/// A region with holes. In a valid polygon (validity.hpp) the outer ring runs counter-clockwise, holes
/// clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
  friend bool operator==(const Polygon&, const Polygon&) = default;
};

inline Box bounding_box(const Ring& ring) {
  Box box{ring.front(), ring.front()};
  for (const Point p : ring) extend(box, p);
  return box;
}

inline std::size_t vertex_count(const Polygon& polygon) {
  std::size_t count = polygon.outer.size();
  for (const Ring& hole : polygon.holes) count += hole.size();
  return count;
}

}  // namespace polynya::geometry
