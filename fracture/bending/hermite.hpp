#pragma once

#include <array>
#include <cmath>

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

/// Five-point Gauss–Legendre rule on [left, right], exact to degree nine [Abramowitz1964, table 25.4].
inline std::array<GaussPoint, 5> gauss_points(double left, double right) {
  constexpr std::array<double, 5> kAbscissae = {-0.906179845938664, -0.538469310105683, 0, 0.538469310105683,
                                                0.906179845938664};
  constexpr std::array<double, 5> kWeights = {0.236926885056189, 0.478628670499366, 0.568888888888889,
                                              0.478628670499366, 0.236926885056189};
  std::array<GaussPoint, 5> rule{};
  const double middle = 0.5 * (left + right), half = 0.5 * (right - left);
  for (std::size_t i = 0; i < 5; ++i) rule[i] = {middle + half * kAbscissae[i], half * kWeights[i]};
  return rule;
}

/// Where a cubic element's curvature converges one order faster than elsewhere: its two Gauss points.
inline std::array<double, 2> stress_points(double left, double right) {
  const double middle = 0.5 * (left + right), offset = 0.5 * (right - left) / std::sqrt(3.0);
  return {middle - offset, middle + offset};
}

}  // namespace polynya::fracture
