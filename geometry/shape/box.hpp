#pragma once

#include <algorithm>

#include "geometry/shape/point.hpp"

namespace polynya::geometry {

/// An axis-aligned box [m].
struct Box {
  Point low;
  Point high;
};

constexpr Box box_around(Point a, Point b) {
  return {{std::min(a.x, b.x), std::min(a.y, b.y)}, {std::max(a.x, b.x), std::max(a.y, b.y)}};
}
constexpr Box united(const Box& a, const Box& b) {
  return {{std::min(a.low.x, b.low.x), std::min(a.low.y, b.low.y)},
          {std::max(a.high.x, b.high.x), std::max(a.high.y, b.high.y)}};
}
constexpr void extend(Box& box, const Box& by) {
  box = united(box, by);
}
constexpr void extend(Box& box, Point by) {
  box = united(box, {by, by});
}
constexpr Box grown(const Box& box, double margin) {
  return {{box.low.x - margin, box.low.y - margin}, {box.high.x + margin, box.high.y + margin}};
}
constexpr bool overlaps(const Box& a, const Box& b) {
  return a.low.x <= b.high.x && b.low.x <= a.high.x && a.low.y <= b.high.y && b.low.y <= a.high.y;
}
constexpr bool contains(const Box& outer, const Box& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace polynya::geometry
