#pragma once

#include <cmath>
#include <numbers>

#include "geometry/shape/point.hpp"

namespace polynya::geometry {

/// A rotation, stored as the cosine and sine of its angle.
struct Rotation {
  double cosine = 1;
  double sine = 0;

  /// Returns the rotation by an angle of up to 1.6e6 rad, with cosine and sine accurate within 1.2e-16. Only + − × are
  /// used, without library functions, so that the bits are the same on every machine. The angle is reduced by multiples
  /// of π/2, which is stored in three parts as in fdlibm [Cody1980]. For the remaining angle, at most π/4, the Taylor
  /// series has an error below 1e-19.
  static Rotation by(double angle_rad) {
    constexpr double kQuarter = 1.57079632673412561417e+00;  // the first 33 bits of π/2: its multiples are exact
    constexpr double kRest = 6.07710050630396597660e-11;     // the next 33 bits
    constexpr double kLast = 2.02226624879595063154e-21;     // the rest
    const double quarters = std::nearbyint(angle_rad * (2 / std::numbers::pi));
    const double r = ((angle_rad - quarters * kQuarter) - quarters * kRest) - quarters * kLast;
    const double z = r * r;
    const double sine =
        r +
        r * z *
            (-1. / 6 +
             z * (1. / 120 + z * (-1. / 5040 +
                                  z * (1. / 362880 + z * (-1. / 39916800 +
                                                          z * (1. / 6227020800 + z * (-1. / 1307674368000 +
                                                                                      z * (1. / 355687428096000))))))));
    const double cosine =
        1 - (0.5 * z -
             z * z *
                 (1. / 24 +
                  z * (-1. / 720 + z * (1. / 40320 + z * (-1. / 3628800 +
                                                          z * (1. / 479001600 + z * (-1. / 87178291200 +
                                                                                     z * (1. / 20922789888000))))))));
    const double of_turn = quarters - 4 * std::floor(quarters / 4);  // no cast, because the angle may be NaN
    if (of_turn == 0) return {cosine, sine};
    if (of_turn == 1) return {-sine, cosine};
    if (of_turn == 2) return {-cosine, -sine};
    return {sine, -cosine};
  }
};

constexpr Vector rotate(Rotation r, Vector v) {
  return {r.cosine * v.x - r.sine * v.y, r.sine * v.x + r.cosine * v.y};
}
constexpr Vector rotate_back(Rotation r, Vector v) {
  return {r.cosine * v.x + r.sine * v.y, -r.sine * v.x + r.cosine * v.y};
}

/// The placement of a body frame in the world: world = position + rotation · body. Poses move shapes; the coordinates
/// of a shape itself are never moved (docs/architecture.md, exactness contract).
struct Pose {
  Point position;     ///< origin of the body frame in the world [m]
  Rotation rotation;  ///< from the body's axes to the world's
};

/// Returns a point of frame b in frame a.
constexpr Point transform(const Pose& a_from_b, Point point_in_b) {
  return a_from_b.position + rotate(a_from_b.rotation, point_in_b - Point{});
}
/// Returns a point of frame a in frame b.
constexpr Point inverse_transform(const Pose& a_from_b, Point point_in_a) {
  return Point{} + rotate_back(a_from_b.rotation, point_in_a - a_from_b.position);
}
/// Returns the pose of frame b in frame a, from the poses of both in the world.
constexpr Pose relative_pose(const Pose& world_from_a, const Pose& world_from_b) {
  const Rotation ra = world_from_a.rotation;
  const Rotation rb = world_from_b.rotation;
  return {inverse_transform(world_from_a, world_from_b.position),
          {ra.cosine * rb.cosine + ra.sine * rb.sine, ra.cosine * rb.sine - ra.sine * rb.cosine}};
}
/// Returns the pose of frame a in frame b.
constexpr Pose inverse(const Pose& a_from_b) {
  return relative_pose(a_from_b, {});
}

}  // namespace polynya::geometry
