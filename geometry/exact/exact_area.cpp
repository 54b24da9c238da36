#include "geometry/exact/exact_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {

namespace {

bool is_finite(const Polygon& polygon) {
  const auto is_finite = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  const auto all_finite = [&](const Ring& ring) { return std::ranges::all_of(ring, is_finite); };
  return all_finite(polygon.outer) && std::ranges::all_of(polygon.holes, all_finite);
}

}  // namespace

double exact_area(const Polygon& polygon) {
  const Polygon* const only[]{&polygon};
  return exact_balance(only, {}, {});
}

double exact_balance(std::span<const Polygon* const> after, std::span<const Polygon* const> before,
                     std::span<const double> terms) {
  const auto finite = [](const Polygon* polygon) { return is_finite(*polygon); };
  if (!std::ranges::all_of(after, finite) || !std::ranges::all_of(before, finite) ||
      !std::ranges::all_of(terms, [](double term) { return std::isfinite(term); }))
    return std::numeric_limits<double>::quiet_NaN();
  exact::Rational sum = 0;
  for (const Polygon* polygon : after) sum += exact::area(*polygon);
  for (const Polygon* polygon : before) sum -= exact::area(*polygon);
  for (const double term : terms) sum += exact::Rational(term);
  return exact::nearest_double(sum);
}

}  // namespace polynya::geometry
