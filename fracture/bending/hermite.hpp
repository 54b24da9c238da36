#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include <boost/math/quadrature/gauss.hpp>

namespace polynya::fracture {

/// The four cubic Hermite shape functions of an element [left, right] at a point, with their derivatives: the
/// deflection and the slope at the left node, then at the right node.
struct HermiteValues {
  std::array<double, 4> value;   ///< N
  std::array<double, 4> first;   ///< N' [1/length]
  std::array<double, 4> second;  ///< N'' [1/length²]
};

inline HermiteValues hermite(double left, double right, double point) {
  const double h = right - left;
  const double s = (point - left) / h;
  const double s2 = s * s, s3 = s2 * s;
  return {{1 - 3 * s2 + 2 * s3, h * (s - 2 * s2 + s3), 3 * s2 - 2 * s3, h * (s3 - s2)},
          {(6 * s2 - 6 * s) / h, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / h, 3 * s2 - 2 * s},
          {(12 * s - 6) / (h * h), (6 * s - 4) / h, (6 - 12 * s) / (h * h), (6 * s - 2) / h}};
}

struct GaussPoint {
  double point;
  double weight;
};

/// Five-point Gauss–Legendre rule on [left, right], exact to degree nine.
inline std::array<GaussPoint, 5> gauss_points(double left, double right) {
  using Rule = boost::math::quadrature::gauss<double, 5>;  // the points from the middle outwards
  const auto& offsets = Rule::abscissa();
  const auto& weights = Rule::weights();
  const double middle = 0.5 * (left + right), half = 0.5 * (right - left);
  const auto at = [&](double side, std::size_t i) {
    return GaussPoint{middle + side * half * offsets[i], half * weights[i]};
  };
  return {at(-1, 2), at(-1, 1), at(1, 0), at(1, 1), at(1, 2)};
}

/// Where a cubic element's curvature converges one order faster than elsewhere: its two Gauss points.
inline std::array<double, 2> stress_points(double left, double right) {
  const double middle = 0.5 * (left + right), offset = 0.5 * (right - left) / std::sqrt(3.0);
  return {middle - offset, middle + offset};
}

}  // namespace polynya::fracture
