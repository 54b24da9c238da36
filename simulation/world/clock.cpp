#include "simulation/world/clock.hpp"

#include <cmath>

namespace polynya::simulation {

bool is_due(const Clock& clock, double interval) {
  constexpr double kRounding = 1e-6;  // [intervals]; a multiple that rounding puts behind a tick still lies in it
  const auto passed = [&](std::int64_t ticks) {
    return std::floor(static_cast<double>(ticks) * clock.tick / interval + kRounding);
  };
  return passed(clock.ticks) > passed(clock.ticks - 1);
}

}  // namespace polynya::simulation
