#include "dynamics/planar.hpp"

namespace polynya::dynamics {

Planar solve(PlanarMatrix a, Planar b) {
  auto& [surge, sway, yaw] = a.rows;
  const double sway_over = sway.surge / surge.surge;
  const double yaw_over = yaw.surge / surge.surge;
  sway = sway - sway_over * surge;
  b.sway -= sway_over * b.surge;
  yaw = yaw - yaw_over * surge;
  b.yaw -= yaw_over * b.surge;
  const double last_over = yaw.sway / sway.sway;
  yaw = yaw - last_over * sway;
  b.yaw -= last_over * b.sway;
  Planar x;
  x.yaw = b.yaw / yaw.yaw;
  x.sway = (b.sway - sway.yaw * x.yaw) / sway.sway;
  x.surge = (b.surge - surge.sway * x.sway - surge.yaw * x.yaw) / surge.surge;
  return x;
}

}  // namespace polynya::dynamics
