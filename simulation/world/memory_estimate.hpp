#pragma once

#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// Estimated memory of a run [bytes]. It covers the data that grow with the number and size of the scene's floes. A run
/// whose `at_start` exceeds the available memory is refused; if only `all_moving` does, a note is printed.
struct MemoryEstimate {
  double at_start = 0;    ///< lower bound of the memory before the first step [bytes]
  double all_moving = 0;  ///< approximate memory if every floe moves and touches its neighbours [bytes]
};

/// Returns the estimate for a scene. It counts vertices, floes and contact circles. The scene counts twice, because the
/// caller and the world each hold a copy.
MemoryEstimate estimate_memory(const Scene& scene);

}  // namespace polynya::simulation
