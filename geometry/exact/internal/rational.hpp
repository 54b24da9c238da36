#pragma once

#include <string>

#include <gmpxx.h>

// Exact numbers. Everything that the code asks of them is here, so that another library can take GMP's place
// (browser/platform has the same header on Boost.Multiprecision).

namespace polynya::geometry::exact {

using Integer = mpz_class;
/// Plain rationals: no lazy expression trees, so no depth limit and no hidden evaluation.
using Rational = mpq_class;

/// −1, 0 or +1.
inline int sign(const Rational& value) {
  return sgn(value);
}
inline Rational magnitude(const Rational& value) {
  return abs(value);
}
/// The value rounded towards 0 to a double.
inline double truncated_double(const Rational& value) {
  return value.get_d();
}
/// value · 2^exponent.
inline Rational scaled(const Rational& value, int exponent) {
  Rational result;
  if (exponent < 0) {
    mpq_div_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(-exponent));
  } else {
    mpq_mul_2exp(result.get_mpq_t(), value.get_mpq_t(), static_cast<mp_bitcnt_t>(exponent));
  }
  return result;
}
/// The largest whole number that is not above the value; it must fit a double.
inline double whole_below(const Rational& value) {
  Integer whole;
  mpz_fdiv_q(whole.get_mpz_t(), value.get_num_mpz_t(), value.get_den_mpz_t());
  return whole.get_d();
}
/// "-3/4", or "2" where the value is whole.
inline std::string digits_of(const Rational& value) {
  return value.get_str();
}
/// value · 2^bits.
inline Integer shifted(const Integer& value, unsigned bits) {
  return value << bits;
}

}  // namespace polynya::geometry::exact
