#pragma once

#include <cmath>
#include <cstdint>
#include <numbers>

namespace polynya::simulation {

// Functions that give the same bits on every machine. They use only + − × ÷ and √, which IEEE 754 rounds uniquely,
// whereas functions of C libraries differ in their last digits. They are accurate to 1e-14 of the value unless stated
// otherwise.

/// Returns e^x for |x| < 700.
inline double portable_exponential(double x) {
  const double k = std::floor(x / std::numbers::ln2 + 0.5);
  const double r = x - k * std::numbers::ln2;
  double term = 1;
  double sum = 1;
  for (int i = 1; i < 18; ++i) sum += term *= r / i;
  return std::ldexp(sum, static_cast<int>(k));
}

/// Returns ln x for x > 0.
inline double portable_logarithm(double x) {
  int exponent = 0;
  double m = std::frexp(x, &exponent);
  if (m < 0.5 * std::numbers::sqrt2) {
    m *= 2;
    --exponent;
  }
  const double y = (m - 1) / (m + 1);
  double power = y;
  double sum = 0;
  for (int k = 1; k < 26; k += 2) {
    sum += power / k;
    power *= y * y;
  }
  return 2 * sum + exponent * std::numbers::ln2;
}

/// Returns x^p for x > 0.
inline double portable_power(double x, double p) {
  return portable_exponential(p * portable_logarithm(x));
}

/// A unit vector.
struct UnitVector {
  double x = 1;
  double y = 0;
};
/// Returns cos and sin of 2π u for 0 ≤ u < 1, by the series for an eighth of a turn.
inline UnitVector portable_direction(double u) {
  const double eighths = std::floor(8 * u);
  const auto turned = static_cast<int>(eighths);
  const double a = (u - eighths / 8) * 2 * std::numbers::pi;
  double c = 0;
  double s = 0;
  double term = 1;
  for (int i = 0; i < 24; i += 2) {
    c += term;
    s += term *= a / (i + 1);
    term *= -a / (i + 2);
  }
  UnitVector v{c, s};
  if (turned % 2 == 1) v = {(c - s) / std::numbers::sqrt2, (c + s) / std::numbers::sqrt2};
  for (int quarter = 0; quarter < turned / 2; ++quarter) v = {-v.y, v.x};
  return v;
}

/// Returns z with P(Z < z) = p for a standard normal variable Z, 0 < p < 1. It is Acklam's rational approximation,
/// accurate to 1.2e-9 of z [Acklam2003].
inline double portable_normal_quantile(double p) {
  if (p > 0.5) return -portable_normal_quantile(1 - p);
  if (p < 0.02425) {
    const double q = std::sqrt(-2 * portable_logarithm(p));
    return (((((-7.784894002430293e-03 * q - 3.223964580411365e-01) * q - 2.400758277161838) * q - 2.549732539343734) *
                 q +
             4.374664141464968) *
                q +
            2.938163982698783) /
           ((((7.784695709041462e-03 * q + 3.224671290700398e-01) * q + 2.445134137142996) * q + 3.754408661907416) *
                q +
            1);
  }
  const double q = p - 0.5;
  const double r = q * q;
  return (((((-3.969683028665376e+01 * r + 2.209460984245205e+02) * r - 2.759285104469687e+02) * r +
            1.383577518672690e+02) *
               r -
           3.066479806614716e+01) *
              r +
          2.506628277459239) *
         q /
         (((((-5.447609879822406e+01 * r + 1.615858368580409e+02) * r - 1.556989798598866e+02) * r +
            6.680131188771972e+01) *
               r -
           1.328068155288572e+01) *
              r +
          1);
}

/// Random numbers (splitmix64 [Steele2014]) that are the same on every machine and with every library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}

  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return z ^ (z >> 31);
  }
  /// Returns a number that is evenly distributed in [0, 1).
  double uniform() { return static_cast<double>(next() >> 11) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  /// Returns a nearly normal number with mean 0 and standard deviation 1: the sum of twelve uniform numbers minus six.
  /// It needs no logarithm.
  double normal() {
    double sum = -6;
    for (int i = 0; i < 12; ++i) sum += uniform();
    return sum;
  }

 private:
  std::uint64_t state_;
};

}  // namespace polynya::simulation
