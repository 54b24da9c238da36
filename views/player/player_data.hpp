#pragma once

#include <cstddef>
#include <string>

#include "io/run/run_reader.hpp"
#include "io/run/thinned_frames.hpp"
#include "views/player/player_shapes.hpp"

namespace polynya::views {

/// What the player's page holds of a run (docs/view.md): words and lists as JSON, numbers as columns.
struct PlayerData {
  std::string info;  ///< JSON
  ColumnWriter columns;
  std::size_t frames = 0;
  double start = 0;  ///< of the frames [s]
  double end = 0;
};

PlayerData player_data(const io::Run& run, const io::FrameSelection& selection);

}  // namespace polynya::views
