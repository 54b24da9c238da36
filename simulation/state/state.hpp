#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Returns all data that decide how a run continues, except for its scene, as bytes. Must be called between two steps,
/// after the journal was written. Doubles are stored bit by bit. Data that follow from shapes (masses, boundaries,
/// drag) are left out, and so are caches that only save time.
std::string save_state(const World& world);

/// Loads a saved state into a world that was made with Start::kEmpty from the same scene. Its next steps are then bit
/// by bit those of the world that was saved. Returns an empty string on success, and otherwise the reason; the world
/// must not be used then. The bytes may be anything: every index, number and shape is checked.
std::string load_state(World& empty, std::string_view bytes);

/// Returns a hash of the state. It is the same wherever the same bits were computed, however often the run was
/// interrupted.
std::uint64_t state_hash(const World& world);

/// Checks a world between two steps: computes every cross-reference and every sum again and compares. Returns the first
/// defect, or nullopt. Takes about as long as a step in which everything moves.
std::optional<std::string> validate_world(const World& world);

}  // namespace polynya::simulation
