#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/polygon.hpp"
#include "io/frames.hpp"
#include "io/json_value.hpp"
#include "io/scene_reader.hpp"
#include "simulation/journal.hpp"

namespace polynya::io {

/// A floe's life in a run.
struct RunFloe {
  simulation::Birth birth;
  double died = std::numeric_limits<double>::infinity();  ///< when it broke [s]
  std::optional<std::size_t> death_event;                 ///< index of the event that broke it
};

/// A run folder read back (docs/run-folder.md): what every tool that looks at runs starts from.
struct Run {
  std::filesystem::path folder;
  LoadedScene scene;
  JsonValue summary;
  std::vector<RunFloe> floes;  ///< by floe id
  std::vector<simulation::Event> events;
  std::vector<simulation::ShipSample> samples;
  std::vector<Frame> frames;

  double start_time() const { return frames.empty() ? 0 : frames.front().time; }
  double end_time() const { return frames.empty() ? 0 : frames.back().time; }
  const RunFloe* floe(simulation::FloeId id) const {
    return id >= 0 && static_cast<std::size_t>(id) < floes.size() ? &floes[static_cast<std::size_t>(id)]
                                                                  : nullptr;
  }
  bool is_alive(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->birth.time <= time && time < floe(id)->died;
  }
  /// The floes that broke to make this one, oldest first, itself last.
  std::vector<simulation::FloeId> lineage(simulation::FloeId id) const;
};

/// Where the floes of a run are, by time. Keeps what frames tell of each floe.
class MotionIndex {
 public:
  explicit MotionIndex(const Run& run);

  /// Motion of a floe's centre of mass at a time: between two frames, linear between what they tell. Nothing
  /// where no frame ever told of the floe.
  std::optional<Motion> floe_at(simulation::FloeId floe, double time) const;
  std::optional<Motion> ship_at(std::size_t ship, double time) const;

 private:
  struct Told {
    double time = 0;  ///< [s]
    Motion motion;
  };
  const Told* last_told(simulation::FloeId floe, double time) const;
  std::vector<double> frame_times_;
  std::vector<std::vector<Told>> floes_;    ///< by floe id, in time order
  std::vector<std::vector<Motion>> ships_;  ///< by ship, one a frame
};

/// The floe's polygon in the world for a motion of its centre of mass.
geometry::Polygon polygon_in_world(const simulation::Birth& birth, const Motion& motion);

/// Reads a run folder, finished or not; a last line or frame that is cut short is left out.
/// What is wrong is told with its file and line.
tl::expected<Run, std::string> read_run(const std::filesystem::path& folder);

}  // namespace polynya::io
