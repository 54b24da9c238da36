#pragma once

#include <deque>
#include <filesystem>
#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"
#include "io/run/frames.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/shape_parts.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::io {

/// Shapes of the floes of a run, as floes.ndjson stores them. A shape that refers to its parent takes memory only for
/// its new vertices, and is assembled on request. The shapes assembled last are kept. Not thread-safe.
class FloeShapes {
 public:
  /// Adds the next floe by id. Throws ReadError, and adds nothing, if the parts cannot refer to that parent.
  void add(ShapeParts shape, simulation::FloeId parent);
  void add(const geometry::Polygon& shape) { add(whole(shape), simulation::kNoFloe); }

  std::size_t size() const { return floes_.size(); }

  /// Returns the shape in the floe's body frame. Needs a floe that was added.
  std::shared_ptr<const geometry::Polygon> of(simulation::FloeId floe) const;

  /// Returns the parts by which the shape refers to its parent; null if it refers to none.
  const ShapeParts* parts_of(simulation::FloeId id) const { return floe(id).whole ? nullptr : &floe(id).parts; }

 private:
  struct Floe {
    simulation::FloeId parent = simulation::kNoFloe;  ///< floe to which its parts refer
    ShapeParts parts;                                 ///< empty if the shape is stored whole
    std::shared_ptr<const geometry::Polygon> whole;
    std::vector<std::size_t> ring_sizes;
  };
  const Floe& floe(simulation::FloeId id) const { return floes_.at(static_cast<std::size_t>(id)); }
  std::shared_ptr<const geometry::Polygon> find(simulation::FloeId id) const;
  void keep(simulation::FloeId id, std::shared_ptr<const geometry::Polygon> shape) const;

  std::vector<Floe> floes_;  ///< by id
  // Cache of the shapes assembled last. It is mutable because it follows from floes_.
  mutable std::unordered_map<simulation::FloeId, std::shared_ptr<const geometry::Polygon>> kept_;
  mutable std::deque<simulation::FloeId> oldest_kept_;
  mutable std::size_t kept_vertices_ = 0;
};

/// Life of a floe in a run.
struct RunFloe {
  simulation::BirthRecord birth;
  /// Time at which it went under a hull [s]; infinite: never.
  double went_under = std::numeric_limits<double>::infinity();
  /// Time at which it broke, or surfaced as a new floe [s]; infinite: it exists to the end.
  double died = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> death_event;  ///< index of the event that broke it
  bool came_up = false;  ///< true if it, or a floe from which it broke, surfaced from under a hull; such ice is brash
};

/// A row of contacts.csv.
struct RunContact {
  double time = 0;  ///< [s]
  simulation::ContactState state;
};

/// A row of crushed.csv.
struct RunCrushed {
  double time = 0;  ///< [s]
  simulation::CrushedOverlap overlap;
};

/// A run folder read into memory (docs/run-folder.md). All commands that read runs start from this.
struct Run {
  std::filesystem::path folder;
  std::string label;  ///< name of the run in figures: the name of its scene unless another is given
  LoadedScene scene;
  JsonValue summary;
  std::vector<RunFloe> floes;  ///< by floe id
  FloeShapes shapes;           ///< their shapes in body frames
  std::vector<simulation::Event> events;
  std::vector<simulation::HullSample> samples;
  std::vector<Frame> frames;
  /// Contacts at frames, in order of time; empty in runs of versions that did not record them.
  std::vector<RunContact> contacts;
  /// Peaks of contact forces, in order of time; empty in runs of versions that did not record them.
  std::vector<RunContact> peaks;
  std::vector<RunCrushed> crushed;  ///< in order of time
  bool has_crushed = false;         ///< false in runs of versions that did not record it

  double start_time() const { return frames.empty() ? 0 : frames.front().time; }
  double end_time() const { return frames.empty() ? 0 : frames.back().time; }
  const RunFloe* floe(simulation::FloeId id) const {
    return id >= 0 && static_cast<std::size_t>(id) < floes.size() ? &floes[static_cast<std::size_t>(id)] : nullptr;
  }
  /// Returns the shape of an existing floe in its body frame.
  std::shared_ptr<const geometry::Polygon> shape(simulation::FloeId id) const { return shapes.of(id); }
  /// Returns true if the floe exists and floats at that time [s].
  bool is_alive(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->birth.time <= time && time < floe(id)->died && time < floe(id)->went_under;
  }
  /// Returns true if the floe is under a hull at that time, or waits behind it for room to surface.
  bool is_under(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->went_under <= time && time < floe(id)->died;
  }
  /// Returns the contacts that were recorded at the time of a frame [s].
  std::span<const RunContact> contacts_at(double time) const;
  /// Returns the sequence of floes that broke one from the other until this one, oldest first, this one last.
  std::vector<simulation::FloeId> lineage(simulation::FloeId id) const;
};

/// Reads a run folder, finished or not. An incomplete last line or frame is ignored. The error has the file and the
/// line.
Result<Run> read_run(const std::filesystem::path& folder);

/// Motions of all bodies of a run by time. It sorts the records of the frames by floe.
class MotionIndex {
 public:
  explicit MotionIndex(const Run& run);

  /// Motion of a floe's centre of mass at a time [s], interpolated linearly between the records of two frames. Returns
  /// nothing if no frame has the floe.
  std::optional<Motion> floe_at(simulation::FloeId floe, double time) const;
  std::optional<Motion> ship_at(std::size_t ship, double time) const;

 private:
  const RecordedMotion* last_record(simulation::FloeId floe, double time) const;
  std::vector<double> frame_times_;
  std::vector<std::vector<RecordedMotion>> floes_;  ///< records by floe id, in order of time
  std::vector<std::vector<Motion>> ships_;          ///< motions by ship, one per frame
};

/// Returns the polygon of a floe in the world for a motion of its centre of mass.
geometry::Polygon polygon_in_world(geometry::Polygon polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion);

/// A floe at its place at some time of a run.
struct PlacedFloe {
  const simulation::BirthRecord* birth = nullptr;            ///< owned by the run
  std::shared_ptr<const geometry::Polygon> polygon_in_body;  ///< [m]
  geometry::Pose world_from_body;
  std::optional<Motion> motion;  ///< motion of its centre of mass; nothing if no frame has it
};

/// Returns the floes that float at a time [s], by id. A floe that existed only between two frames is placed as the floe
/// from which it broke, whose body frame it shares. A floe that no frame has is placed where it was at its beginning.
std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time);
/// Calls use(floe) for each of these floes, one at a time. This saves memory: the polygons of a million floes take 200
/// MB.
void for_floes_at(const Run& run, const MotionIndex& motions, double time,
                  const std::function<void(const PlacedFloe&)>& use);

/// Returns, in the same way, the floes that are under hulls at that time or wait behind them for room to surface.
std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time);

/// Returns the pose of a floe's body frame for a motion of its centre of mass.
geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion);

/// Returns the pose of a ship in the world at a time [s]; its pose in the scene if the run has no frames.
geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time);

/// Returns the times of the frames up to a time, and that time itself [s].
std::vector<double> frame_times_until(const Run& run, double time);

/// A selection of the frames of a run.
struct FrameSelection {
  int every = 1;                                           ///< only each n-th frame, and the last one
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double until = std::numeric_limits<double>::infinity();  ///< [s]

  bool is_all() const { return every <= 1 && from < -1e300 && until > 1e300; }
  bool has(double time) const { return from <= time && time <= until; }
};

/// Returns the selected frames. The record of a floe in a frame that is left out is moved to the next selected frame,
/// extrapolated at its velocity. So at every selected frame each living floe has the place and velocity of the run.
std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection);

}  // namespace polynya::io
