#pragma once

#include <optional>
#include <string>

#include "simulation/world.hpp"

namespace polynya::simulation {

/// Derives every cross-index and every sum of a world anew, between two steps. What is off, in words; nothing
/// where all is well. Costs about as much as a step in which everything moves.
std::optional<std::string> validate_world(const World& world);

}  // namespace polynya::simulation
