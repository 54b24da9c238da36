#pragma once

#include <optional>
#include <string>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Derives every cross-index and every sum of a world again, between two steps. Returns the first defect;
/// nothing where all is well. Costs about as much as a step in which everything moves.
std::optional<std::string> validate_world(const World& world);

}  // namespace polynya::simulation
