#include "fracture/bending/published_forms.hpp"

#include <algorithm>
#include <array>

#include <boost/math/interpolators/cardinal_cubic_b_spline.hpp>

#include "elementary/elementary.hpp"
#include "fracture/characteristic_length.hpp"

namespace polynya::fracture {
namespace {

constexpr double kStep = 0.1;  // of s = (a/l)^⅓
// (r/l) / s at s = 0, 0.1, … 1.5. The peak stress of a small load lies at r ∝ a^⅓, so this ratio is smooth. Converged
// values of solve_floating_beam in extended precision (800 elements); at s = 0 the limit (2 / w(0))^⅓.
constexpr std::array<double, 16> kRadiusOverRoot = {0.97064, 0.99147, 1.01525, 1.04320, 1.07673, 1.11757,
                                                    1.16793, 1.23077, 1.31008, 1.41128, 1.54147, 1.70922,
                                                    1.92252, 2.18336, 2.48096, 2.79479};

/// Returns the factor 1 + C_v v of Kashtelyan's radius [-] at a speed [m/s]. It is negative from 7 m/s on.
double radius_factor(double approach_speed) {
  return 1 - 0.144 * approach_speed;
}

/// Lower limit of that factor, so that R stays positive [-].
constexpr double kSmallestRadiusFactor = 0.2;

}  // namespace

double nevel_force(double opening_angle, double load_length_over_l, const Ice& ice) {
  const double a = load_length_over_l;
  const double width_growth = 2 * elementary::tan(0.5 * opening_angle);
  return (1.05 + 2 * a + 0.5 * a * a * a) * width_growth * ice.flexural_strength * ice.thickness * ice.thickness / 6;
}

double nevel_cusp_radius_over_l(double load_length_over_l) {
  // Slopes of the ratio at both ends of the table, which continue its first and last differences.
  constexpr double kFirstSlope = 0.19, kLastSlope = 3.2;
  static const boost::math::interpolators::cardinal_cubic_b_spline<double> kRatio(
      kRadiusOverRoot.begin(), kRadiusOverRoot.end(), 0.0, kStep, kFirstSlope, kLastSlope);
  constexpr double kLast = kStep * (kRadiusOverRoot.size() - 1);
  const double root = elementary::cbrt(std::max(load_length_over_l, 0.0));
  return kRatio(std::min(root, kLast)) * root;
}

BendingCapacity NevelModel::capacity(const BendingLoad& load) const {
  const double l = characteristic_length(load.ice, load.water);
  const double load_length = load.penetration / l;
  const double opening_angle = load.front_half_angle + load.back_half_angle;
  BendingCapacity result;
  result.vertical_force = nevel_force(opening_angle, load_length, load.ice);
  result.cusp_radius = nevel_cusp_radius_over_l(load_length) * l;
  result.is_in_range = load_length <= kLargestNevelLoadLength && opening_angle <= kWidestNevelWedge;
  return result;
}

double kashtelyan_force(double opening_angle, const Ice& ice) {
  constexpr double kForce = 3.1;  // C_f
  const double share = opening_angle / std::numbers::pi;
  return kForce * share * share * ice.flexural_strength * ice.thickness * ice.thickness;
}

double kashtelyan_radius(double characteristic_length, double approach_speed) {
  constexpr double kRadius = 0.32;  // C_l
  return kRadius * characteristic_length * std::max(radius_factor(approach_speed), kSmallestRadiusFactor);
}

BendingCapacity KashtelyanModel::capacity(const BendingLoad& load) const {
  BendingCapacity result;
  result.vertical_force = kashtelyan_force(load.front_half_angle + load.back_half_angle, load.ice);
  result.cusp_radius = kashtelyan_radius(characteristic_length(load.ice, load.water), load.mean_approach_speed);
  result.is_in_range = radius_factor(load.mean_approach_speed) >= kSmallestRadiusFactor;
  return result;
}

}  // namespace polynya::fracture
