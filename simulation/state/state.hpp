#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// All that decides how a run continues, beside its scene, as bytes: doubles bit by bit. Taken between two
/// steps, after the journal. What follows from shapes (masses, boundaries, drag) is left out, and so is what
/// only culls.
std::string save_state(const World& world);

/// Brings a world made with Start::kEmpty from the same scene to a saved state: its next steps are bit by bit
/// those of the world that was saved. Returns why it cannot, and the world is of no use then; empty where all
/// is well. The bytes may be anything: every index, number and shape is checked.
std::string load_state(World& empty, std::string_view bytes);

/// A hash of the state, the same wherever the same bits were computed, however often the run was interrupted.
std::uint64_t state_hash(const World& world);

/// Derives every cross-index and every sum of a world again, between two steps. Returns the first defect;
/// nothing where all is well. Costs about as much as a step in which everything moves.
std::optional<std::string> validate_world(const World& world);

}  // namespace polynya::simulation
