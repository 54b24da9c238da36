#pragma once

namespace polynya::simulation {

/// A run whose bodies reach this speed, rims included, ends as a numerical failure; a scene that starts so is
/// refused [m/s].
inline constexpr double kRunawaySpeed = 1e3;

}  // namespace polynya::simulation
