/* For musl's sources, which are unchanged, in place of the C library's header: their functions get names of our own, so
   that a program never takes them for those of its C library. */
#pragma once
#include_next <math.h>
#define sin polynya_sin
#define cos polynya_cos
#define tan polynya_tan
#define asin polynya_asin
#define acos polynya_acos
#define atan polynya_atan
#define atan2 polynya_atan2
#define exp polynya_exp
#define log polynya_log
#define pow polynya_pow
#define cbrt polynya_cbrt
#define hypot polynya_hypot
#define log1p polynya_log1p
#define expm1 polynya_expm1
#define log10 polynya_log10
#define sinh polynya_sinh
#define cosh polynya_cosh
#define asinh polynya_asinh
#define erf polynya_erf
#define erfc polynya_erfc
#define __sin polynya_inner_sin
#define __cos polynya_inner_cos
#define __tan polynya_inner_tan
#define __sinl polynya_inner_sinl
#define __cosl polynya_inner_cosl
#define __tanl polynya_inner_tanl
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
double polynya_erf(double);
double polynya_erfc(double);
