#pragma once

#include <cmath>
#include <limits>
#include <string>

#include <boost/multiprecision/cpp_int.hpp>

// Takes the place of geometry/exact/internal/rational.hpp, which is on GMP: a browser has no GMP.

namespace polynya::geometry::exact {

using Integer = boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;
/// Without expression templates, as CGAL expects its numbers.
using Rational =
    boost::multiprecision::number<boost::multiprecision::rational_adaptor<boost::multiprecision::cpp_int_backend<>>,
                                  boost::multiprecision::et_off>;

/// −1, 0 or +1.
inline int sign(const Rational& value) {
  return value.sign();
}
inline Rational magnitude(const Rational& value) {
  return value.sign() < 0 ? Rational(-value) : value;
}
/// The value rounded towards 0 to a double. Boost's own conversion is near it.
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
/// value · 2^exponent.
inline Rational scaled(const Rational& value, int exponent) {
  const Integer power = Integer(1) << static_cast<unsigned>(exponent < 0 ? -exponent : exponent);
  return exponent < 0 ? Rational(value / power) : Rational(value * power);
}
/// The largest whole number that is not above the value; it must fit a double.
inline double whole_below(const Rational& value) {
  const Integer above = numerator(value), below = denominator(value);
  Integer whole = above / below;
  if (above < 0 && whole * below != above) --whole;
  return whole.convert_to<double>();
}
/// "-3/4", or "2" where the value is whole.
inline std::string digits_of(const Rational& value) {
  return denominator(value) == 1 ? numerator(value).str() : value.str();
}
/// value · 2^bits.
inline Integer shifted(const Integer& value, unsigned bits) {
  return value << bits;
}

}  // namespace polynya::geometry::exact
