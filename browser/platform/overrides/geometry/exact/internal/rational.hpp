#pragma once

#include <cmath>
#include <limits>
#include <string>

#include <boost/multiprecision/cpp_int.hpp>

// Replaces geometry/exact/internal/rational.hpp, which uses GMP, because a browser has no GMP.

namespace polynya::geometry::exact {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
/// CGAL needs numbers without expression templates.
using Rational =
    boost::multiprecision::number<boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
                                  boost::multiprecision::et_off>;

/// Returns −1, 0 or +1.
inline int sign(const Rational& value) {
  return value.sign();
}
inline Rational magnitude(const Rational& value) {
  return value.sign() < 0 ? Rational(-value) : value;
}
/// Returns the value rounded towards 0 to a double. Boost's own conversion gives a double near it.
inline double truncated_double(const Rational& value) {
  const double far =
      value.sign() < 0 ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  double rounded = value.convert_to<double>();
  const Rational size = magnitude(value);
  while (std::isfinite(rounded) && Rational(std::abs(rounded)) > size) rounded = std::nextafter(rounded, 0.0);
  for (double next = std::nextafter(rounded, far); std::isfinite(next) && Rational(std::abs(next)) <= size;
       next = std::nextafter(rounded, far))
    rounded = next;
  return rounded;
}
/// Returns value · 2^exponent.
inline Rational scaled(const Rational& value, int exponent) {
  const Integer power = Integer(1) << static_cast<unsigned>(exponent < 0 ? -exponent : exponent);
  return exponent < 0 ? Rational(value / power) : Rational(value * power);
}
/// Returns the largest whole number that is at most the value, which must fit into a double.
inline double whole_below(const Rational& value) {
  const Integer above = numerator(value), below = denominator(value);
  Integer whole = above / below;
  if (above < 0 && whole * below != above) --whole;
  return whole.convert_to<double>();
}
/// Returns "-3/4", or "2" for a whole value.
inline std::string digits_of(const Rational& value) {
  return denominator(value) == 1 ? numerator(value).str() : value.str();
}
/// Returns value · 2^bits.
inline Integer shifted(const Integer& value, unsigned bits) {
  return value << bits;
}

}  // namespace polynya::geometry::exact
