#pragma once

#include <cstddef>
#include <string>

#include "io/player_shapes.hpp"
#include "io/run_reader.hpp"
#include "io/thinned_frames.hpp"

namespace polynya::io {

/// What the player's page holds of a run (docs/view.md): words and lists as JSON, numbers as columns.
struct PlayerData {
  std::string info;  ///< JSON
  ColumnWriter columns;
  std::size_t frames = 0;
};

PlayerData player_data(const Run& run, const FrameSelection& selection);

}  // namespace polynya::io
