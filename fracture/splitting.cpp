#include "fracture/splitting.hpp"

namespace polynya::fracture {

using geometry::Vector;

std::optional<std::array<Push, 2>> wedge_pushes(Vector force, const std::array<Face, 2>& faces, double friction) {
  constexpr double kLeastAngle = 1e-6;  // between the forces of the faces [rad]
  if (std::max(faces[0].leaving, faces[1].leaving) > kFullSlip) return std::nullopt;
  const auto direction = [&](const Face& face) {
    return face.normal + friction * std::clamp(face.slip / kFullSlip, -1.0, 1.0) * perpendicular(face.normal);
  };
  const Vector first = direction(faces[0]);
  const Vector second = direction(faces[1]);
  const double turn = cross(first, second);
  if (std::abs(turn) < kLeastAngle) return std::nullopt;
  const double on_first = cross(force, second) / turn;
  const double on_second = cross(first, force) / turn;
  if (on_first < 0 || on_second < 0) return std::nullopt;
  return {{{{faces[0].middle, on_first * first}, {faces[1].middle, on_second * second}}}};
}

double Opening::force() const {
  return std::max(0.0, std::min(left, right));
}

Opening opening_of(std::span<const Push> pushes, geometry::Point mouth, Vector direction) {
  const Vector to_left = perpendicular(direction);
  Opening opening;
  for (const Push& push : pushes) {
    const double apart = dot(push.force, to_left);
    if (dot(push.at - mouth, to_left) > 0)
      opening.left += apart;
    else
      opening.right -= apart;
  }
  return opening;
}

}  // namespace polynya::fracture
