#include "geometry/exact/measures.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/exact/internal/areas.hpp"
#include "geometry/exact/internal/error_free.hpp"

namespace polynya::geometry {
namespace {

// Calls visit(u, v, w) for each edge a→b with u = a − origin, v = b − origin, w = u × v. Taking vertices from
// a nearby origin first is what keeps the digits of a polygon far from its frame's origin.
template <typename Visit>
void for_each_edge(const Ring& ring, Point origin, Visit visit) {
  if (ring.empty()) return;
  Vector u = ring.back() - origin;
  for (const Point p : ring) {
    const Vector v = p - origin;
    visit(u, v, cross(u, v));
    u = v;
  }
}

template <typename Visit>
void for_each_edge(const Polygon& polygon, Point origin, Visit visit) {
  for_each_edge(polygon.outer, origin, visit);
  for (const Ring& hole : polygon.holes) for_each_edge(hole, origin, visit);
}

double ring_length(const Ring& ring) {
  CompensatedSum sum;
  for_each_edge(ring, Point{}, [&sum](Vector u, Vector v, double) { sum += length(v - u); });
  return sum.total();
}

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

double signed_area(const Ring& ring) {
  return nearest_area(ring);
}

Measures measure(const Polygon& polygon) {
  if (polygon.outer.size() < 3) return {};
  const Box box = bounding_box(polygon.outer);
  const Point origin = midpoint(box.low, box.high);
  const Vector size = box.high - box.low;
  Measures result;
  result.area = nearest_area(polygon);
  // The sums below err by some u = 1e-16 of the box's moments for each vertex: they are good as long as the
  // region fills more than a small part of its box. Smaller, moments of slivers are noise; larger, rationals
  // measure floes, a thousand times slower.
  constexpr double kThin = 1e-6;
  if (std::abs(result.area) < kThin * size.x * size.y) return exact_measures(polygon);
  if (result.area == 0) return {0, origin, 0};
  CompensatedSum first_x;
  CompensatedSum first_y;
  for_each_edge(polygon, origin, [&](Vector u, Vector v, double w) {
    first_x += w * (u.x + v.x);
    first_y += w * (u.y + v.y);
  });
  const Vector offset = Vector{first_x.total(), first_y.total()} / (6 * result.area);
  result.centroid = origin + offset;
  CompensatedSum second;  // about the centroid directly: no parallel-axis subtraction
  for_each_edge(polygon, origin, [&](Vector u, Vector v, double) {
    const Vector a = u - offset;
    const Vector b = v - offset;
    second += cross(a, b) * (dot(a, a) + dot(a, b) + dot(b, b));
  });
  result.second_moment = second.total() / 12;
  return result;
}

double perimeter(const Polygon& polygon) {
  double sum = ring_length(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += ring_length(hole);
  return sum;
}

double area_in_band(const Polygon& polygon, double half_width) {
  double area = ring_area_in_band(polygon.outer, half_width);
  for (const Ring& hole : polygon.holes) area += ring_area_in_band(hole, half_width);
  return area;
}

}  // namespace polynya::geometry
