#pragma once

#include <array>

namespace polynya::dynamics {

/// Surge, sway and yaw in a ship's axes (x forward, y to port, yaw counter-clockwise): velocities [m/s, m/s, rad/s],
/// forces [N, N, N m] or impulses [N s, N s, N m s].
struct Planar {
  double surge = 0;
  double sway = 0;
  double yaw = 0;
  friend bool operator==(const Planar&, const Planar&) = default;
};

constexpr Planar operator+(Planar a, Planar b) {
  return {a.surge + b.surge, a.sway + b.sway, a.yaw + b.yaw};
}
constexpr Planar operator-(Planar a, Planar b) {
  return {a.surge - b.surge, a.sway - b.sway, a.yaw - b.yaw};
}
constexpr Planar operator*(double s, Planar a) {
  return {s * a.surge, s * a.sway, s * a.yaw};
}
constexpr Planar& operator+=(Planar& a, Planar b) {
  return a = a + b;
}
/// Returns the power of a force at a velocity [W], or the work of an impulse at the mean velocity [J].
constexpr double dot(Planar a, Planar b) {
  return a.surge * b.surge + a.sway * b.sway + a.yaw * b.yaw;
}

/// A matrix from velocities to forces or impulses.
struct PlanarMatrix {
  std::array<Planar, 3> rows{};  ///< rows that give surge, sway and yaw

  friend constexpr PlanarMatrix operator+(const PlanarMatrix& a, const PlanarMatrix& b) {
    return {{a.rows[0] + b.rows[0], a.rows[1] + b.rows[1], a.rows[2] + b.rows[2]}};
  }
  friend constexpr PlanarMatrix operator*(double s, const PlanarMatrix& a) {
    return {{s * a.rows[0], s * a.rows[1], s * a.rows[2]}};
  }
  friend constexpr Planar operator*(const PlanarMatrix& a, Planar x) {
    return {dot(a.rows[0], x), dot(a.rows[1], x), dot(a.rows[2], x)};
  }
};

/// Returns x of a x = b, by elimination without pivoting. The symmetric part of `a` must be positive definite.
Planar solve(PlanarMatrix a, Planar b);

}  // namespace polynya::dynamics
