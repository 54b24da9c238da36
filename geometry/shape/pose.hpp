#pragma once

#include <cmath>

#include "geometry/shape/point.hpp"

namespace polynya::geometry {

/// A rotation by an angle kept as its cosine and sine.
struct Rotation {
  double cosine = 1;
  double sine = 0;

  static Rotation by(double angle_rad) { return {std::cos(angle_rad), std::sin(angle_rad)}; }
};

constexpr Vector rotate(Rotation r, Vector v) {
  return {r.cosine * v.x - r.sine * v.y, r.sine * v.x + r.cosine * v.y};
}
constexpr Vector rotate_back(Rotation r, Vector v) {
  return {r.cosine * v.x + r.sine * v.y, -r.sine * v.x + r.cosine * v.y};
}

/// A rigid placement of a body frame in the world: world = position + rotation · body.
/// Poses carry shapes; a shape's own coordinates are never moved (docs/architecture.md, exactness contract).
struct Pose {
  Point position;     ///< the body frame's origin in the world [m]
  Rotation rotation;  ///< from the body's axes to the world's
};

/// The point of frame b, in frame a.
constexpr Point transform(const Pose& a_from_b, Point point_in_b) {
  return a_from_b.position + rotate(a_from_b.rotation, point_in_b - Point{});
}
/// The point of frame a, in frame b.
constexpr Point inverse_transform(const Pose& a_from_b, Point point_in_a) {
  return Point{} + rotate_back(a_from_b.rotation, point_in_a - a_from_b.position);
}
/// The pose of frame b in frame a, from both in the world.
constexpr Pose relative_pose(const Pose& world_from_a, const Pose& world_from_b) {
  const Rotation ra = world_from_a.rotation;
  const Rotation rb = world_from_b.rotation;
  return {inverse_transform(world_from_a, world_from_b.position),
          {ra.cosine * rb.cosine + ra.sine * rb.sine, ra.cosine * rb.sine - ra.sine * rb.cosine}};
}
/// The pose of frame a in frame b.
constexpr Pose inverse(const Pose& a_from_b) {
  return relative_pose(a_from_b, {});
}

}  // namespace polynya::geometry
