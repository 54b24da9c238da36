#include "geometry/exact/internal/ring_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/internal/nearest_area.hpp"
#include "geometry/shape/internal/compensated_sum.hpp"

namespace polynya::geometry {
RingArea ring_area(const Ring& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return {};
  const Point origin = ring.front();
  // Two sums side by side: one alone waits for its own last addition.
  CompensatedSum even;
  CompensatedSum odd;
  double reach_x = 0;  // of all vertices from the origin
  double reach_y = 0;
  Vector u{0, 0};
  const auto term_to = [&](Point p) {
    const Vector v = p - origin;
    const double term = cross(u, v);
    reach_x = std::max(reach_x, std::abs(v.x));
    reach_y = std::max(reach_y, std::abs(v.y));
    u = v;
    return term;
  };
  std::size_t i = 1;
  for (; i + 1 < n; i += 2) {
    even += term_to(ring[i]);
    odd += term_to(ring[i + 1]);
  }
  if (i < n) even += term_to(ring[i]);  // the closing edge ends in the origin: its term is zero
  const double twice = (even.value + odd.value) + (even.lost + odd.lost);
  const double largest = std::max(std::abs(origin.x) + reach_x, std::abs(origin.y) + reach_y);
  const double step = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  const auto edges = static_cast<double>(n);
  // Each term errs by at most 4ε of its two products, the compensated sums by next to nothing.
  constexpr double kUnderflow = 1e-280;
  return {twice / 2, 8 * std::numeric_limits<double>::epsilon() * edges * 2 * reach_x * reach_y + kUnderflow,
          4 * edges * (reach_x + reach_y) * step};
}

double area_of(const Polygon& polygon, const std::vector<RingArea>& rings) {
  RingArea sum;
  for (const RingArea& ring : rings) {
    sum.area += ring.area;
    sum.doubt += ring.doubt;
  }
  constexpr double kWorstDoubt = 1e-6;  // of the area
  return sum.doubt > kWorstDoubt * std::abs(sum.area) ? nearest_area(polygon) : sum.area;
}

double area_of(const Polygon& polygon) {
  std::vector<RingArea> rings{ring_area(polygon.outer)};
  for (const Ring& hole : polygon.holes) rings.push_back(ring_area(hole));
  return area_of(polygon, rings);
}

}  // namespace polynya::geometry
