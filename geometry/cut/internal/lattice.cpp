#include "geometry/cut/internal/lattice.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

namespace polynya::geometry::exact {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

// value · 2^exponent
Rational scaled(const Rational& value, int exponent) {
  Rational result;
  if (exponent < 0) {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  } else {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  }
  return result;
}

double farthest(const Polygon& polygon) {
  double size = 0;
  const auto see = [&size](const Ring& ring) {
    for (const Point& p : ring)
      size = std::max({size, std::abs(nearest_double(p.x)), std::abs(nearest_double(p.y))});
  };
  see(polygon.outer);
  for (const Ring& hole : polygon.holes) see(hole);
  return size;
}

}  // namespace

Lattice Lattice::spanning(const Polygon& polygon) {
  constexpr int kFinest = std::numeric_limits<double>::min_exponent - std::numeric_limits<double>::digits;
  const double size = farthest(polygon);
  if (size == 0) return Lattice(false, kFinest);
  return Lattice(false, std::max(std::ilogb(size) + 1 - std::numeric_limits<double>::digits, kFinest));
}

double Lattice::nearest(const Rational& value) const {
  if (is_of_doubles_) return nearest_double(value);
  const Rational shifted = scaled(value, -exponent_) + Rational(1, 2);
  mpz_class steps;
  mpz_fdiv_q(steps.get_mpz_t(), shifted.get_num_mpz_t(), shifted.get_den_mpz_t());
  return std::ldexp(steps.get_d(), exponent_);
}

Cell Lattice::cell(double centre) const {
  const Rational middle(centre);
  if (!is_of_doubles_) {
    const Rational half = scaled(1, exponent_ - 1);
    return {middle - half, middle + half, true, false};
  }
  const bool is_even = std::bit_cast<std::uint64_t>(centre) % 2 == 0;
  return {(middle + Rational(std::nextafter(centre, -kFar))) / 2,
          (middle + Rational(std::nextafter(centre, kFar))) / 2, is_even, is_even};
}

double Lattice::width(double size) const {
  return is_of_doubles_ ? std::nextafter(size, kFar) - size : std::ldexp(1.0, exponent_);
}

}  // namespace polynya::geometry::exact
