#pragma once

extern "C" {
double polynya_sin(double);
double polynya_cos(double);
double polynya_tan(double);
double polynya_asin(double);
double polynya_acos(double);
double polynya_atan(double);
double polynya_atan2(double, double);
double polynya_exp(double);
double polynya_log(double);
double polynya_pow(double, double);
double polynya_cbrt(double);
double polynya_hypot(double, double);
double polynya_log1p(double);
double polynya_expm1(double);
double polynya_log10(double);
double polynya_sinh(double);
double polynya_cosh(double);
double polynya_asinh(double);
double polynya_erfc(double);
}

/// Elementary functions that are the same to the bit on every machine, in the native program and in a browser. They are
/// musl's, in elementary/vendor. The C library's own differ in their last digits from one library to the next, and from
/// one processor to the next. The model calls no others. (Square roots, remainders and rounding are exact in IEEE 754:
/// those of the standard library are the same everywhere.)
namespace polynya::elementary {

inline double sin(double x) {
  return polynya_sin(x);
}
inline double cos(double x) {
  return polynya_cos(x);
}
inline double tan(double x) {
  return polynya_tan(x);
}
inline double asin(double x) {
  return polynya_asin(x);
}
inline double acos(double x) {
  return polynya_acos(x);
}
inline double atan(double x) {
  return polynya_atan(x);
}
inline double atan2(double y, double x) {
  return polynya_atan2(y, x);
}
inline double exp(double x) {
  return polynya_exp(x);
}
inline double log(double x) {
  return polynya_log(x);
}
inline double pow(double x, double exponent) {
  return polynya_pow(x, exponent);
}
/// A whole power by multiplication, which is faster.
constexpr double pow(double x, int exponent) {
  double power = 1;
  for (unsigned left = exponent < 0 ? 0U - static_cast<unsigned>(exponent) : static_cast<unsigned>(exponent); left > 0;
       left /= 2) {
    if (left % 2 == 1) power *= x;
    x *= x;
  }
  return exponent < 0 ? 1 / power : power;
}
inline double cbrt(double x) {
  return polynya_cbrt(x);
}
inline double hypot(double x, double y) {
  return polynya_hypot(x, y);
}
/// log(1 + x)
inline double log1p(double x) {
  return polynya_log1p(x);
}
/// exp(x) − 1
inline double expm1(double x) {
  return polynya_expm1(x);
}
inline double log10(double x) {
  return polynya_log10(x);
}
inline double sinh(double x) {
  return polynya_sinh(x);
}
inline double cosh(double x) {
  return polynya_cosh(x);
}
inline double asinh(double x) {
  return polynya_asinh(x);
}
/// The complementary error function.
inline double erfc(double x) {
  return polynya_erfc(x);
}

}  // namespace polynya::elementary
