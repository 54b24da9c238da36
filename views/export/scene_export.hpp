#pragma once

#include <string>
#include <utility>
#include <vector>

#include "io/run/run_reader.hpp"

namespace polynya::views {

/// A scene that continues a run from one of its instants.
struct ContinuedScene {
  double time = 0;  ///< of the frame that it continues from [s]
  /// scene.json and floes.geojson, which it names.
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> left_out;  ///< what of the run's state they do not have, in words
};

/// The scene of a run as it stands at the last frame up to a time: its ships and floes where they are, with
/// their velocities, lineage and thickness, everything else as in the run's scene.json. The clock starts at
/// 0.
io::Result<ContinuedScene> continued_scene(const io::Run& run, double time);

}  // namespace polynya::views
