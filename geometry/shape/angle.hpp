#pragma once

#include <numbers>

namespace polynya::geometry {

inline constexpr double kDegreesPerRadian = 180 / std::numbers::pi;
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180;

}  // namespace polynya::geometry
