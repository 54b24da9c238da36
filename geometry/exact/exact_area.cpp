#include "geometry/exact/exact_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {

namespace {

bool is_finite(const Polygon& polygon) {
  const auto all_finite = [](const Ring& ring) {
    return std::all_of(ring.begin(), ring.end(),
                       [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); });
  };
  return all_finite(polygon.outer) && std::all_of(polygon.holes.begin(), polygon.holes.end(), all_finite);
}

}  // namespace

double exact_area(const Polygon& polygon) {
  const Polygon* const only[]{&polygon};
  return exact_balance(only, {}, {});
}

double exact_balance(std::span<const Polygon* const> after, std::span<const Polygon* const> before,
                     std::span<const double> terms) {
  const auto finite = [](const Polygon* polygon) { return is_finite(*polygon); };
  if (!std::all_of(after.begin(), after.end(), finite) ||
      !std::all_of(before.begin(), before.end(), finite) ||
      !std::all_of(terms.begin(), terms.end(), [](double term) { return std::isfinite(term); }))
    return std::numeric_limits<double>::quiet_NaN();
  exact::Rational sum = 0;
  for (const Polygon* polygon : after) sum += exact::area(*polygon);
  for (const Polygon* polygon : before) sum -= exact::area(*polygon);
  for (const double term : terms) sum += exact::Rational(term);
  return exact::nearest_double(sum);
}

}  // namespace polynya::geometry
