#include "geometry/exact/internal/exact_polygon.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <limits>

namespace polynya::geometry::exact {
namespace {

/// Returns a polygon with every vertex converted.
template <typename Result, typename AnyPolygon, typename Convert>
Result converted(const AnyPolygon& polygon, Convert convert) {
  Result result;
  const auto add = [&](const auto& ring, auto& into) {
    into.reserve(ring.size());
    std::ranges::transform(ring, std::back_inserter(into), convert);
  };
  add(polygon.outer, result.outer);
  for (const auto& hole : polygon.holes) add(hole, result.holes.emplace_back());
  return result;
}

template <typename AnyPolygon>
Rational sum_of_areas(const AnyPolygon& polygon) {
  Rational sum = area(polygon.outer);
  for (const auto& hole : polygon.holes) sum += area(hole);
  return sum;
}

// A pairwise sum: the terms that are added have similar sizes, so the numbers stay short.
Rational shoelace_sum(const Ring& ring, std::size_t first, std::size_t last) {
  if (last - first == 1) return shoelace_term(ring[first], ring[(first + 1) % ring.size()]);
  const std::size_t middle = first + (last - first) / 2;
  return shoelace_sum(ring, first, middle) + shoelace_sum(ring, middle, last);
}

}  // namespace

double nearest_double(const Rational& value) {
  const double truncated = truncated_double(value);
  if (!std::isfinite(truncated)) return truncated;
  const Rational remainder = value - Rational(truncated);
  const int side = sign(remainder);
  if (side == 0) return truncated;
  const double next = std::nextafter(
      truncated, side > 0 ? std::numeric_limits<double>::infinity() : -std::numeric_limits<double>::infinity());
  if (!std::isfinite(next)) return truncated;
  const Rational gap = Rational(next) - Rational(truncated);
  const int nearer = sign(Rational(magnitude(Rational(2 * remainder)) - magnitude(gap)));
  if (nearer != 0) return nearer < 0 ? truncated : next;
  const bool is_even = std::bit_cast<std::uint64_t>(truncated) % 2 == 0;
  return is_even ? truncated : next;
}

Ring exactly(const geometry::Ring& ring) {
  return exactly(geometry::Polygon{ring, {}}).outer;
}
Polygon exactly(const geometry::Polygon& polygon) {
  return converted<Polygon>(polygon, [](geometry::Point p) { return exactly(p); });
}
geometry::Polygon rounded(const Polygon& polygon) {
  return converted<geometry::Polygon>(polygon, [](const Point& p) { return rounded(p); });
}

Rational area(const Ring& ring) {
  if (ring.empty()) return 0;
  return shoelace_sum(ring, 0, ring.size()) / 2;
}
Rational area(const Polygon& polygon) {
  return sum_of_areas(polygon);
}
// Doubles are whole multiples of one power of two, so integers are enough; they are an order of magnitude faster.
Rational area(const geometry::Ring& ring) {
  constexpr int kDigits = std::numeric_limits<double>::digits;
  int unit = std::numeric_limits<int>::max();  // largest power of two of which all coordinates are multiples
  const auto include = [&unit](double value) {
    int exponent = 0;
    std::frexp(value, &exponent);
    if (value != 0) unit = std::min(unit, exponent - kDigits);
  };
  for (const geometry::Point p : ring) {
    include(p.x);
    include(p.y);
  }
  if (ring.size() < 3 || unit == std::numeric_limits<int>::max()) return 0;
  const auto in_units = [unit](double value) {
    int exponent = 0;
    const double digits = std::ldexp(std::frexp(value, &exponent), kDigits);
    const Integer whole(digits);
    return value == 0 ? whole : shifted(whole, static_cast<unsigned>(exponent - kDigits - unit));
  };
  const std::size_t n = ring.size();
  Integer twice = 0;
  Integer before = in_units(ring[n - 1].y);
  Integer here = in_units(ring[0].y);
  for (std::size_t i = 0; i < n; ++i) {
    Integer after = in_units(ring[i + 1 == n ? 0 : i + 1].y);
    twice += in_units(ring[i].x) * (after - before);
    before = std::move(here);
    here = std::move(after);
  }
  return scaled(Rational(twice), 2 * unit - 1);
}
Rational area(const geometry::Polygon& polygon) {
  return sum_of_areas(polygon);
}

}  // namespace polynya::geometry::exact
