#include "dynamics/ship/manoeuvring.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "elementary/elementary.hpp"

namespace polynya::dynamics {
namespace {

/// Returns ∫|v + x r| xᵏ dx from `aft` to `fore` for k = 0, 1, 2 [m/s · m^(k+1)].
std::array<double, 3> cross_flow_moments(double v, double r, double aft, double fore) {
  const auto part = [&](double from, double to) {
    std::array<double, 3> sums{};
    double low = from, high = to;  // powers k + 1
    for (std::size_t k = 0; k < 3; ++k) {
      const auto n = static_cast<double>(k + 1);
      sums[k] = v * (high - low) / n + r * (high * to - low * from) / (n + 1);
      low *= from;
      high *= to;
    }
    if (sums[0] < 0)
      for (double& sum : sums) sum = -sum;
    return sums;
  };
  const double pivot = r != 0 ? std::clamp(-v / r, aft, fore) : fore;  // where the cross flow changes its direction
  std::array<double, 3> moments = part(aft, pivot);
  const std::array<double, 3> rest = part(pivot, fore);
  for (std::size_t k = 0; k < 3; ++k) moments[k] += rest[k];
  return moments;
}

}  // namespace

bool ManoeuvringDerivatives::are_physical() const {
  const double coupling = y_r + n_v;
  return y_v_dot < 0 && n_r_dot < 0 && y_v < 0 && n_r < 0 && 4 * y_v * n_r >= coupling * coupling;
}

ManoeuvringDerivatives clarke_derivatives(const MainDimensions& hull) {
  const double t = hull.draught / hull.length;
  const double b = hull.beam / hull.length;
  const double bt = hull.beam / hull.draught;
  const double cb = hull.block_coefficient;
  const double k = -std::numbers::pi * t * t;
  return {.y_v_dot = k * (1 + 0.16 * cb * bt - 5.1 * b * b),
          .y_r_dot = k * (0.67 * b - 0.0033 * bt * bt),
          .n_v_dot = k * (1.1 * b - 0.041 * bt),
          .n_r_dot = k * (1 / 12.0 + 0.017 * cb * bt - 0.33 * b),
          .y_v = k * (1 + 0.40 * cb * bt),
          .y_r = k * (-0.5 + 2.2 * b - 0.080 * bt),
          .n_v = k * (0.5 + 2.4 * t),
          .n_r = k * (0.25 + 0.039 * bt - 0.56 * b)};
}

double wetted_surface(const MainDimensions& hull) {
  return 1.7 * hull.length * hull.draught + hull.block_coefficient * hull.length * hull.beam;
}

PlanarMatrix added_mass_of(const ManoeuvringDerivatives& derivatives, double length, double density, double in_surge) {
  const double sway = -0.5 * density * elementary::pow(length, 3) * derivatives.y_v_dot;
  const double yaw = -0.5 * density * elementary::pow(length, 5) * derivatives.n_r_dot;
  const double mean = -0.25 * density * elementary::pow(length, 4) * (derivatives.y_r_dot + derivatives.n_v_dot);
  const double most = 0.99 * std::sqrt(std::max(0.0, sway * yaw));
  const double coupling = std::clamp(mean, -most, most);
  return {{{{in_surge, 0, 0}, {0, sway, coupling}, {0, coupling, yaw}}}};
}

PlanarMatrix water_damping(const HullInWater& hull, Planar through_water) {
  const auto [u, v, r] = through_water;
  const auto& d = hull.derivatives;
  const double l = hull.length;
  const double area = 0.5 * hull.density * l * l;  // ½ρL²
  const double across = 0.5 * hull.density * hull.draught * hull.cross_flow_drag;
  const std::array<double, 3> flow = cross_flow_moments(v, r, hull.aft, hull.fore);
  PlanarMatrix damping;
  auto& [surge, sway, yaw] = damping.rows;
  surge.surge = hull.quadratic_resistance * std::abs(u);
  sway.sway = -area * d.y_v * std::abs(u) + across * flow[0];
  sway.yaw = -area * l * d.y_r * u + across * flow[1];
  yaw.sway = -area * l * d.n_v * u + across * flow[1];
  yaw.yaw = -area * l * l * d.n_r * std::abs(u) + across * flow[2];
  return damping;
}

}  // namespace polynya::dynamics
