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
/// its new vertices, and is assembled on request. The shapes assembled last are kept, up to 64 MB. Not thread-safe, not
/// even its const functions.
class FloeShapes {
 public:
  /// Adds the floe with the next id: the first call adds floe 0. `parent` is the floe to whose vertices the parts
  /// refer; it is not used if they refer to none. Throws ReadError, and adds nothing, if the parts cannot refer to that
  /// parent.
  void add(ShapeParts shape, simulation::FloeId parent);
  /// Adds the floe with the next id by its whole shape.
  void add(const geometry::Polygon& shape) { add(whole(shape), simulation::kNoFloe); }

  std::size_t size() const { return floes_.size(); }  ///< number of floes

  /// Returns the shape in the floe's body frame. Throws std::out_of_range if no floe of that id was added.
  std::shared_ptr<const geometry::Polygon> of(simulation::FloeId floe) const;

  /// Returns the parts by which the shape refers to its parent; null if it refers to none.
  const ShapeParts* parts_of(simulation::FloeId id) const { return floe(id).whole ? nullptr : &floe(id).parts; }

 private:
  struct Floe {
    simulation::FloeId parent = simulation::kNoFloe;  ///< floe to which its parts refer
    ShapeParts parts;                                 ///< empty if the shape is stored whole
    std::shared_ptr<const geometry::Polygon> whole;   ///< null if the shape is stored as parts
    std::vector<std::size_t> ring_sizes;  ///< numbers of vertices of its rings, by which parts of children are checked
  };
  const Floe& floe(simulation::FloeId id) const { return floes_.at(static_cast<std::size_t>(id)); }
  std::shared_ptr<const geometry::Polygon> find(simulation::FloeId id) const;
  void keep(simulation::FloeId id, std::shared_ptr<const geometry::Polygon> shape) const;

  std::vector<Floe> floes_;  ///< by id
  // Cache of the shapes assembled last, the oldest first in oldest_kept_. It is mutable because it follows from floes_.
  mutable std::unordered_map<simulation::FloeId, std::shared_ptr<const geometry::Polygon>> kept_;
  mutable std::deque<simulation::FloeId> oldest_kept_;
  mutable std::size_t kept_vertices_ = 0;
};

/// Life of a floe in a run. A floe whose outline changes dies, and its pieces are new floes.
struct RunFloe {
  simulation::BirthRecord birth;
  /// Time at which it went under a hull [s]; infinite: never.
  double went_under = std::numeric_limits<double>::infinity();
  /// Time at which it broke, was ground, surfaced from under a hull as a new floe, or was left under the ice for good
  /// [s]; infinite: it exists to the end.
  double died = std::numeric_limits<double>::infinity();
  std::optional<std::size_t> death_event;  ///< index in Run::events of the event at `died`; nothing if there is none
  bool came_up = false;  ///< true if it, or a floe from which it broke, surfaced from under a hull; such ice is brash
};

/// A row of contacts.csv: a contact at a frame, or the peak of a contact's force.
struct RunContact {
  double time = 0;  ///< time of the frame or of the peak [s]
  simulation::ContactState state;
};

/// A row of crushed.csv: how much of their overlap two bodies have crushed.
struct RunCrushed {
  double time = 0;  ///< time of a frame [s]
  simulation::CrushedOverlap overlap;
};

/// A run folder read into memory (docs/run-folder.md). All commands that read runs start from this.
struct Run {
  std::filesystem::path folder;
  std::string label;  ///< name of the run in figures: the name of its scene unless another is given
  LoadedScene scene;
  JsonValue summary;                            ///< summary.json, whose members have been checked (fault_of_summary)
  std::vector<RunFloe> floes;                   ///< by floe id
  FloeShapes shapes;                            ///< their shapes in body frames
  std::vector<simulation::Event> events;        ///< in the order of events.ndjson
  std::vector<simulation::HullSample> samples;  ///< rows of forces.csv
  std::vector<Frame> frames;                    ///< in order of time
  /// Contacts at frames, in order of time; empty if the scene records none, or in runs of versions without them.
  std::vector<RunContact> contacts;
  /// Peaks of contact forces, in order of time; empty if the scene records none, or in runs of versions without them.
  std::vector<RunContact> peaks;
  std::vector<RunCrushed> crushed;  ///< in order of time
  bool has_crushed = false;         ///< false in runs of versions that did not record it

  /// Return the times of the first and of the last frame [s]; 0 if there are no frames.
  double start_time() const { return frames.empty() ? 0 : frames.front().time; }
  double end_time() const { return frames.empty() ? 0 : frames.back().time; }
  /// Returns the floe of that id, or null if the run never had it.
  const RunFloe* floe(simulation::FloeId id) const {
    return id >= 0 && static_cast<std::size_t>(id) < floes.size() ? &floes[static_cast<std::size_t>(id)] : nullptr;
  }
  /// Returns the shape of a floe that the run has or had, in its body frame.
  std::shared_ptr<const geometry::Polygon> shape(simulation::FloeId id) const { return shapes.of(id); }
  /// Returns true if the floe exists and floats at that time [s].
  bool is_alive(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->birth.time <= time && time < floe(id)->died && time < floe(id)->went_under;
  }
  /// Returns true if at that time [s] the floe is under a hull, or waits behind it for room to surface.
  bool is_under(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->went_under <= time && time < floe(id)->died;
  }
  /// Returns the contacts that were recorded at exactly the time of a frame [s]; none for a time between frames.
  std::span<const RunContact> contacts_at(double time) const;
  /// Returns the ancestors of a floe, the floe of the scene first, and the floe itself last. The list is empty if the
  /// run never had the floe.
  std::vector<simulation::FloeId> lineage(simulation::FloeId id) const;
};

/// Reads a run folder, finished or not. An incomplete last line or frame, as a killed run leaves it, is ignored in an
/// unfinished run and an error in a finished one. Fails if the folder has no run, is of a later version, or if a file
/// is missing that all versions write, or if a file is longer than kLongestRunFile or damaged. The message has the
/// file, and the line or frame if there is one.
Result<Run> read_run(const std::filesystem::path& folder);

/// Motions of all bodies of a run at any time. It sorts the records of the frames by floe, and needs the run only while
/// it is built.
class MotionIndex {
 public:
  explicit MotionIndex(const Run& run);

  /// Returns the motion of a floe's centre of mass at a time [s]; nothing if no frame has the floe. If the next frame
  /// has a record of the floe, the motion is interpolated linearly between the two frames. Otherwise it is the last
  /// record up to then, or the first record if there is none before, extrapolated at constant velocity. The function
  /// does not check whether the floe exists at that time.
  std::optional<Motion> floe_at(simulation::FloeId floe, double time) const;
  /// Returns the motion of the origin of a hull's frame, by the hull's number in the scene, interpolated linearly
  /// between two frames. Before the first frame it is that of the first one; after the last frame it is extrapolated at
  /// constant velocity. Returns nothing if the run has no frames.
  std::optional<Motion> ship_at(std::size_t ship, double time) const;

 private:
  const RecordedMotion* last_record(simulation::FloeId floe, double time) const;
  std::vector<double> frame_times_;
  std::vector<std::vector<RecordedMotion>> floes_;  ///< records by floe id, in order of time
  std::vector<std::vector<Motion>> ships_;          ///< motions by number of the hull, one per frame
};

/// Returns the polygon of a floe in the world [m] for a motion of its centre of mass, which in the body frame is at
/// `centroid_in_body` [m].
geometry::Polygon polygon_in_world(geometry::Polygon polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion);

/// A floe at its place at some time of a run.
struct PlacedFloe {
  const simulation::BirthRecord* birth = nullptr;            ///< owned by the run
  std::shared_ptr<const geometry::Polygon> polygon_in_body;  ///< [m]
  geometry::Pose world_from_body;
  std::optional<Motion> motion;  ///< motion of its centre of mass; nothing if no frame has it
};

/// Returns the floes that float at a time [s], by id. A floe that existed only between two frames, so that no frame has
/// it, is placed as its youngest ancestor that a frame has, whose body frame it shares. If no frame has any of them, it
/// is placed where the scene has its oldest ancestor.
std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time);
/// Calls use(floe) for each of these floes, one at a time. This saves memory: the polygons of a million floes take 200
/// MB.
void for_floes_at(const Run& run, const MotionIndex& motions, double time,
                  const std::function<void(const PlacedFloe&)>& use);

/// Returns, in the same way, the floes that are under hulls at that time or wait behind them for room to surface.
std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time);

/// Returns the pose of a floe's body frame in the world for a motion of its centre of mass.
geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion);

/// Returns the pose of a hull's frame in the world at a time [s], by its number in the scene; its pose in the scene if
/// the run has no frames.
geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time);

/// Returns the times of the frames before a time, and then that time itself [s], for the track of a ship until then.
std::vector<double> frame_times_until(const Run& run, double time);

/// The frames of a run that a user selects, so that exports and pages of long runs become shorter.
struct FrameSelection {
  /// The first of the frames from `from` to `until`, each n-th after it, and the last one are selected. At least 1.
  int every = 1;
  double from = -std::numeric_limits<double>::infinity();  ///< first time [s]
  double until = std::numeric_limits<double>::infinity();  ///< last time [s]

  bool is_all() const { return every <= 1 && from < -1e300 && until > 1e300; }
  /// Returns true if the time [s] lies within the limits; `every` is not considered.
  bool has(double time) const { return from <= time && time <= until; }
};

/// Returns the selected frames. The record of a floe in a frame that is left out is moved to the next selected frame,
/// extrapolated at its velocity, if the floe still exists then. So at every selected frame each living floe has the
/// place and velocity of the run, to the tolerances of frames.hpp.
std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection);

}  // namespace polynya::io
