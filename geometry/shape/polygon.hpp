#pragma once

#include <algorithm>
#include <vector>

#include "geometry/shape/point.hpp"

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

/// An axis-aligned box [m].
struct Box {
  Point low;
  Point high;
};

inline Box bounding_box(const Ring& ring) {
  Box box{ring.front(), ring.front()};
  for (const Point p : ring) {
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  return box;
}
constexpr bool overlaps(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}
constexpr Box grown(const Box& box, double margin) {
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}

inline std::size_t vertex_count(const Polygon& polygon) {
  std::size_t count = polygon.outer.size();
  for (const Ring& hole : polygon.holes) count += hole.size();
  return count;
}

}  // namespace polynya::geometry
