#include "simulation/world/clock.hpp"

#include <cmath>

namespace polynya::simulation {

bool is_due(const Clock& clock, double interval) {
  // Tolerance of rounding, as a fraction of the interval [-]. A multiple of the interval that rounding puts just behind
  // the end of a tick still belongs to the tick. A much larger value makes an instant due one tick too early.
  constexpr double kRounding = 1e-6;
  const auto passed = [&](std::int64_t ticks) {
    return std::floor(static_cast<double>(ticks) * clock.tick / interval + kRounding);
  };
  return passed(clock.ticks) > passed(clock.ticks - 1);
}

}  // namespace polynya::simulation
