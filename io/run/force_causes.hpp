#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "simulation/world/scene.hpp"

namespace polynya::io {

/// A part of the force on a ship by what causes it: a column of forces.csv, without the columns that are
/// shares of it. The parts of one direction add up to the force on the ship, mass × acceleration
/// (docs/run-folder.md). To add one, add a line to force_causes.cpp.
struct ForceCause {
  std::string_view direction;  ///< title of the player's plot that stacks the parts: "Surge force by cause"
  std::string_view cause;      ///< "friction": names its colour
  std::string_view words;      ///< as people read it: "ice: friction"
  std::string_view column;     ///< of forces.csv
  std::string_view share_of = {};  ///< the column that contains this one; empty: none
  std::string_view without_shares =
      {};  ///< words for a column whose shares are shown apart; empty: it has none
};

/// Every one there is.
std::span<const ForceCause> force_causes();

/// Those whose columns the player plots of a scene's runs.
std::vector<ForceCause> force_causes(const simulation::Scene& scene);

}  // namespace polynya::io
