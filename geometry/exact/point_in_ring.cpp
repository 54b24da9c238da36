#include "geometry/exact/point_in_ring.hpp"

namespace polynya::geometry {

int side_of_ring(const Ring& ring, Point p) {
  bool inside = false;
  Point a = ring.back();
  for (const Point b : ring) {
    const bool is_level = a.y == p.y && b.y == p.y;
    const bool may_hold =
        p.x <= std::max(a.x, b.x) && p.x >= std::min(a.x, b.x) && (is_level || (a.y > p.y) != (b.y > p.y));
    if (b == p || (may_hold && orientation(a, b, p) == 0)) return 0;
    if (crosses_ray(a, b, p)) inside = !inside;
    a = b;
  }
  return inside ? 1 : -1;
}

bool contains(const Polygon& polygon, Point point) {
  if (polygon.outer.empty()) return false;
  const int side = side_of_ring(polygon.outer, point);
  bool inside = side > 0;
  if (side == 0) return true;
  for (const Ring& hole : polygon.holes) {
    const int of_hole = hole.empty() ? -1 : side_of_ring(hole, point);
    if (of_hole == 0) return true;
    if (of_hole > 0) inside = !inside;
  }
  return inside;
}

bool contains_strictly(const Polygon& polygon, Point p) {
  if (side_of_ring(polygon.outer, p) <= 0) return false;
  return std::all_of(polygon.holes.begin(), polygon.holes.end(),
                     [p](const Ring& hole) { return side_of_ring(hole, p) < 0; });
}

}  // namespace polynya::geometry
