#pragma once

#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// Memory of a run of a scene, of what grows with its floes [bytes].
struct MemoryEstimate {
  double at_start = 0;    ///< it takes at least this much before the first step
  double all_moving = 0;  ///< and about this much where every floe comes to move and to touch others
};

/// Counted from vertices, floes and contact circles; `scene` twice, as the caller's and as the world's.
MemoryEstimate estimate_memory(const Scene& scene);

}  // namespace polynya::simulation
