#include "app/dangling.hpp"

#include <algorithm>

#include "geometry/exact/measures.hpp"
#include "geometry/exact/point_in_ring.hpp"

namespace polynya::app {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

template <class Use>
void for_edges(const Polygon& polygon, Use use) {
  const auto of_ring = [&](const Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) use(ring[i], ring[(i + 1) % ring.size()]);
  };
  of_ring(polygon.outer);
  for (const Ring& hole : polygon.holes) of_ring(hole);
}

/// Where along a→b (0 to 1) edges of the polygon cross it, with both ends, in order.
std::vector<double> crossings(Point a, Point b, const Polygon& polygon) {
  std::vector<double> at{0, 1};
  const Vector along = b - a;
  for_edges(polygon, [&](Point p, Point q) {
    const double side_p = cross(along, p - a);
    const double side_q = cross(along, q - a);
    if ((side_p < 0) == (side_q < 0)) return;
    const Point meeting = p + (side_p / (side_p - side_q)) * (q - p);
    const double part = dot(meeting - a, along) / squared_length(along);
    if (part > 0 && part < 1) at.push_back(part);
  });
  std::ranges::sort(at);
  return at;
}

bool is_on_an_edge(Point point, const std::vector<Polygon>& polygons, double tolerance) {
  bool found = false;
  for (const Polygon& polygon : polygons) {
    for_edges(polygon,
              [&](Point p, Point q) { found = found || distance_to_segment(point, p, q) <= tolerance; });
    if (found) return true;
  }
  return false;
}

}  // namespace

std::vector<io::Dangling> find_dangling(const std::vector<Point>& path, const Polygon& before,
                                        const std::vector<Polygon>& after) {
  const geometry::Box box = bounding_box(before.outer);
  const double tolerance = 1e-9 * std::max({length(box.high - box.low), length(box.low - Point{}) * 1e-3});
  std::vector<io::Dangling> found;
  for (std::size_t i = 1; i < path.size(); ++i) {
    const Point a = path[i - 1];
    const Vector along = path[i] - a;
    const std::vector<double> at = crossings(a, path[i], before);
    for (std::size_t k = 1; k < at.size(); ++k) {
      if ((at[k] - at[k - 1]) * length(along) <= tolerance) continue;
      const Point middle = a + 0.5 * (at[k - 1] + at[k]) * along;
      if (!contains(before, middle) || is_on_an_edge(middle, after, tolerance)) continue;
      found.push_back({a + at[k - 1] * along, a + at[k] * along});
    }
  }
  return found;
}

}  // namespace polynya::app
