#include "geometry/exact/internal/rational.hpp"

#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace polynya::geometry::exact {

double nearest_double(const Rational& value) {
  const double truncated = value.get_d();
  if (!std::isfinite(truncated)) return truncated;
  const Rational remainder = value - Rational(truncated);
  const int side = sgn(remainder);
  if (side == 0) return truncated;
  const double next = std::nextafter(truncated, side > 0 ? std::numeric_limits<double>::infinity()
                                                         : -std::numeric_limits<double>::infinity());
  if (!std::isfinite(next)) return truncated;
  const Rational gap = Rational(next) - Rational(truncated);
  const int nearer = cmp(abs(Rational(2 * remainder)), abs(gap));
  if (nearer != 0) return nearer < 0 ? truncated : next;
  const bool is_even = std::bit_cast<std::uint64_t>(truncated) % 2 == 0;
  return is_even ? truncated : next;
}

}  // namespace polynya::geometry::exact
