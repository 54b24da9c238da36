#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/point.hpp"
#include "io/run/motion_index.hpp"
#include "io/run/run_reader.hpp"
#include "views/player/player_shapes.hpp"

namespace polynya::views {

/// What the player's page holds of a run (docs/view.md): words and lists as JSON, numbers as columns.
struct PlayerData {
  std::string info;  ///< JSON
  ColumnWriter columns;
  std::size_t frames = 0;
  std::size_t floes = 0;
  std::size_t floe_bytes = 0;   ///< of `columns`: shapes and particulars
  std::size_t frame_bytes = 0;  ///< of `columns`: where everything is over time
  double start = 0;             ///< of the frames [s]
  double end = 0;
};

/// Which part of a run a page holds.
struct PlayerSelection {
  io::FrameSelection frames;
  std::optional<geometry::Box> area;  ///< only floes that come within it, and their families
};

PlayerData player_data(const io::Run& run, const PlayerSelection& selection);

/// Of each floe of a run how far a box has to grow on all sides for the floe, or one of its family (all that
/// broke from one floe of the scene), to come within it at one of these frames [m]; 0 where one does as it
/// is. By the floes' circles and the boxes of their ways from record to record.
std::vector<double> family_distances(const io::Run& run, const geometry::Box& box,
                                     const std::vector<io::Frame>& frames);

}  // namespace polynya::views
