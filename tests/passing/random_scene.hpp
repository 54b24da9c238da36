#pragma once

#include <cstdint>

#include "simulation/world/scene.hpp"

namespace polynya::tests {

/// A scene in which bodies run into each other: one to three ships and structures, and floes of hard shapes
/// (planks, arches, hooks, stars, rings) at rest or moving at up to 1 m/s. The laws take turns.
simulation::Scene random_scene(std::uint64_t seed);

}  // namespace polynya::tests
