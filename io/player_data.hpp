#pragma once

#include <cstddef>
#include <string>

#include "io/player_shapes.hpp"
#include "io/run_reader.hpp"
#include "io/thinned_frames.hpp"

namespace polynya::io {

struct PlayerOptions {
  FrameSelection frames;
  std::size_t most_circles = 500'000;  ///< the layer is left out where there are more; 0: always
  std::string channel;                 ///< GeoJSON of the open water to show; empty: the swept band
};

/// What the player's page holds of a run (docs/view.md): words and lists as JSON, numbers as columns.
struct PlayerData {
  std::string info;  ///< JSON
  ColumnWriter columns;
  std::size_t frames = 0;
  bool has_circles = false;
};

PlayerData player_data(const Run& run, const PlayerOptions& options);

}  // namespace polynya::io
