#include "geometry/internal/exact_polygon.hpp"

#include <algorithm>
#include <iterator>

namespace polynya::geometry::exact {
namespace {

template <typename AnyRing, typename Convert>
auto convert_ring(const AnyRing& ring, Convert convert) {
  std::vector<decltype(convert(ring.front()))> result;
  result.reserve(ring.size());
  std::transform(ring.begin(), ring.end(), std::back_inserter(result), convert);
  return result;
}

template <typename Result, typename AnyPolygon, typename Convert>
Result convert_polygon(const AnyPolygon& polygon, Convert convert) {
  Result result{convert(polygon.outer), {}};
  for (const auto& hole : polygon.holes) result.holes.push_back(convert(hole));
  return result;
}

// A pairwise sum: the terms that meet are of like size, so the numbers stay short.
Rational shoelace_sum(const Ring& ring, std::size_t first, std::size_t last) {
  if (last - first == 1) return shoelace_term(ring[first], ring[(first + 1) % ring.size()]);
  const std::size_t middle = first + (last - first) / 2;
  return shoelace_sum(ring, first, middle) + shoelace_sum(ring, middle, last);
}

}  // namespace

Ring exactly(const geometry::Ring& ring) {
  return convert_ring(ring, [](geometry::Point p) { return exactly(p); });
}
Polygon exactly(const geometry::Polygon& polygon) {
  return convert_polygon<Polygon>(polygon, [](const geometry::Ring& ring) { return exactly(ring); });
}
geometry::Ring rounded(const Ring& ring) {
  return convert_ring(ring, [](const Point& p) { return rounded(p); });
}
geometry::Polygon rounded(const Polygon& polygon) {
  return convert_polygon<geometry::Polygon>(polygon, [](const Ring& ring) { return rounded(ring); });
}

Rational area(const Ring& ring) {
  if (ring.empty()) return 0;
  return shoelace_sum(ring, 0, ring.size()) / 2;
}
Rational area(const Polygon& polygon) {
  Rational sum = area(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += area(hole);
  return sum;
}
Rational area(const geometry::Ring& ring) {
  return area(exactly(ring));
}
Rational area(const geometry::Polygon& polygon) {
  return area(exactly(polygon));
}

}  // namespace polynya::geometry::exact
