#include "geometry/shape/band_area.hpp"

#include <algorithm>

namespace polynya::geometry {
namespace {

/// Signed area between an edge and the x axis, of its part below y = `limit`; above it the edge counts as
/// drawn along that line: ∫ min(y, limit) dx along the edge [m²].
double area_below(Point from, Point to, double limit) {
  const double dx = to.x - from.x;
  const double low = std::min(from.y, to.y);
  const double high = std::max(from.y, to.y);
  if (high <= limit) return 0.5 * (low + high) * dx;
  if (low >= limit) return limit * dx;
  const double share = (limit - low) / (high - low);  // of the edge below the limit
  return (share * 0.5 * (low + limit) + (1 - share) * limit) * dx;
}

double ring_area_in_band(const Ring& ring, double half_width) {
  double area = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point from = ring[i];
    const Point to = ring[(i + 1) % ring.size()];
    area -= area_below(from, to, half_width) - area_below(from, to, -half_width);
  }
  return area;
}

}  // namespace

double area_in_band(const Polygon& polygon, double half_width) {
  double area = ring_area_in_band(polygon.outer, half_width);
  for (const Ring& hole : polygon.holes) area += ring_area_in_band(hole, half_width);
  return area;
}

}  // namespace polynya::geometry
