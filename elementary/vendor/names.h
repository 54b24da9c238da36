/* Included before each of musl's sources (CMakeLists.txt), which are unchanged: their functions get names of our own, so
   that a program never takes them for those of its C library. Fused multiply-add is left out: the same operations are
   done on every processor. */
#pragma once
#include <math.h>
#undef __FP_FAST_FMA
#define hidden __attribute__((visibility("hidden")))
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
#define __sin polynya_sin_near_0
#define __cos polynya_cos_near_0
#define __tan polynya_tan_near_0
#define __rem_pio2 polynya_rem_pio2
#define __rem_pio2_large polynya_rem_pio2_large
#define __sinl polynya_unused_sinl
#define __cosl polynya_unused_cosl
#define __tanl polynya_unused_tanl
#define __expo2 polynya_expo2
#define __math_divzero polynya_math_divzero
#define __math_invalid polynya_math_invalid
#define __math_oflow polynya_math_oflow
#define __math_uflow polynya_math_uflow
#define __math_xflow polynya_math_xflow
#define __exp_data polynya_exp_data
#define __log_data polynya_log_data
#define __pow_log_data polynya_pow_log_data
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
