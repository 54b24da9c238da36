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

/// The shapes of a run's floes, as floes.ndjson has them: those that are parts of their parents' take the
/// memory of what is new, and are assembled when asked for. The last ones assembled are kept. Not for several
/// threads at once.
class FloeShapes {
 public:
  /// The next floe, by id. Throws ReadError where the parts cannot be of that parent; nothing is added then.
  void add(ShapeParts shape, simulation::FloeId parent);
  void add(const geometry::Polygon& shape) { add(whole(shape), simulation::kNoFloe); }

  std::size_t size() const { return floes_.size(); }

  /// In the floe's body frame. Needs a floe that was added.
  std::shared_ptr<const geometry::Polygon> of(simulation::FloeId floe) const;

  /// What of the floe's shape is its parent's; null where nothing is.
  const ShapeParts* parts_of(simulation::FloeId id) const { return floe(id).whole ? nullptr : &floe(id).parts; }

 private:
  struct Floe {
    simulation::FloeId parent = simulation::kNoFloe;  ///< that its parts are of
    ShapeParts parts;                                 ///< empty where it is whole
    std::shared_ptr<const geometry::Polygon> whole;
    std::vector<std::size_t> ring_sizes;
  };
  const Floe& floe(simulation::FloeId id) const { return floes_.at(static_cast<std::size_t>(id)); }
  std::shared_ptr<const geometry::Polygon> find(simulation::FloeId id) const;
  void keep(simulation::FloeId id, std::shared_ptr<const geometry::Polygon> shape) const;

  std::vector<Floe> floes_;  ///< by id
  // What was assembled last: it follows from floes_, so that const functions may change it.
  mutable std::unordered_map<simulation::FloeId, std::shared_ptr<const geometry::Polygon>> kept_;
  mutable std::deque<simulation::FloeId> oldest_kept_;
  mutable std::size_t kept_vertices_ = 0;
};

/// A floe's life in a run.
struct RunFloe {
  simulation::BirthRecord birth;
  double went_under = std::numeric_limits<double>::infinity();  ///< a hull [s]
  double died = std::numeric_limits<double>::infinity();        ///< when it broke, or came up as another [s]
  std::optional<std::size_t> death_event;                       ///< index of the event that broke it
  bool came_up = false;  ///< it, or a floe that it broke from, came up from under a hull: brash
};

/// A line of contacts.csv.
struct RunContact {
  double time = 0;  ///< [s]
  simulation::ContactState state;
};

/// A line of crushed.csv.
struct RunCrushed {
  double time = 0;  ///< [s]
  simulation::CrushedOverlap overlap;
};

/// A run folder read back (docs/run-folder.md): what every tool for runs starts from.
struct Run {
  std::filesystem::path folder;
  std::string label;  ///< names the run in figures: its scene's name unless another is given
  LoadedScene scene;
  JsonValue summary;
  std::vector<RunFloe> floes;  ///< by floe id
  FloeShapes shapes;           ///< theirs, in their body frames
  std::vector<simulation::Event> events;
  std::vector<simulation::HullSample> samples;
  std::vector<Frame> frames;
  std::vector<RunContact> contacts;  ///< at frames, as time goes; none in runs of versions that did not record them
  std::vector<RunContact> peaks;     ///< of a contact's force, as time goes; none in runs of versions before
  std::vector<RunCrushed> crushed;   ///< as time goes
  bool has_crushed = false;          ///< runs of versions before do not record it

  double start_time() const { return frames.empty() ? 0 : frames.front().time; }
  double end_time() const { return frames.empty() ? 0 : frames.back().time; }
  const RunFloe* floe(simulation::FloeId id) const {
    return id >= 0 && static_cast<std::size_t>(id) < floes.size() ? &floes[static_cast<std::size_t>(id)] : nullptr;
  }
  /// The shape of a floe that there is, in its body frame.
  std::shared_ptr<const geometry::Polygon> shape(simulation::FloeId id) const { return shapes.of(id); }
  /// Whether it floats then.
  bool is_alive(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->birth.time <= time && time < floe(id)->died && time < floe(id)->went_under;
  }
  /// Whether it is under a hull then, or waits for room behind it.
  bool is_under(simulation::FloeId id, double time) const {
    return floe(id) != nullptr && floe(id)->went_under <= time && time < floe(id)->died;
  }
  /// Those recorded at the time of a frame.
  std::span<const RunContact> contacts_at(double time) const;
  /// The floes that broke to make this one, oldest first, itself last.
  std::vector<simulation::FloeId> lineage(simulation::FloeId id) const;
};

/// Reads a run folder, finished or not; a last line or frame that is cut short is left out.
/// The error has the file and the line.
Result<Run> read_run(const std::filesystem::path& folder);

/// Where the floes of a run are, by time: the frames' records, by floe.
class MotionIndex {
 public:
  explicit MotionIndex(const Run& run);

  /// Motion of a floe's centre of mass at a time: between two frames, linear between their records. Nothing
  /// where no frame has the floe.
  std::optional<Motion> floe_at(simulation::FloeId floe, double time) const;
  std::optional<Motion> ship_at(std::size_t ship, double time) const;

 private:
  const RecordedMotion* last_record(simulation::FloeId floe, double time) const;
  std::vector<double> frame_times_;
  std::vector<std::vector<RecordedMotion>> floes_;  ///< by floe id, in time order
  std::vector<std::vector<Motion>> ships_;          ///< by ship, one a frame
};

/// A floe's polygon in the world for a motion of its centre of mass.
geometry::Polygon polygon_in_world(geometry::Polygon polygon_in_body, geometry::Point centroid_in_body,
                                   const Motion& motion);

/// A floe where it was at some time of a run.
struct PlacedFloe {
  const simulation::BirthRecord* birth = nullptr;            ///< the run's
  std::shared_ptr<const geometry::Polygon> polygon_in_body;  ///< [m]
  geometry::Pose world_from_body;
  std::optional<Motion> motion;  ///< of its centre of mass; nothing where no frame has it
};

/// The floes that float at a time, by id. A floe that lived between two frames is placed as the floe it broke
/// from was, whose body frame it shares; one that no frame has, where it was born.
std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time);
/// Calls use(floe) for each of them, one at a time: all of a million floes, with their polygons, take 200 MB.
void for_floes_at(const Run& run, const MotionIndex& motions, double time,
                  const std::function<void(const PlacedFloe&)>& use);

/// Those under hulls then, or waiting for room behind them, likewise.
std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time);

/// The body frame of a floe whose centre of mass moves so.
geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion);

/// Where a ship's frame is in the world; where the scene puts it if the run has no frames.
geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time);

/// The times of the frames up to a time, and that time itself [s].
std::vector<double> frame_times_until(const Run& run, double time);

/// Which of a run's frames are wanted.
struct FrameSelection {
  int every = 1;                                           ///< only each n-th frame, and the last
  double from = -std::numeric_limits<double>::infinity();  ///< [s]
  double until = std::numeric_limits<double>::infinity();  ///< [s]

  bool is_all() const { return every <= 1 && from < -1e300 && until > 1e300; }
  bool has(double time) const { return from <= time && time <= until; }
};

/// The selected frames. A floe's record in a frame between them is carried on to the next one that stays, so
/// at every frame that stays each floe alive is where the run has it, at the run's velocity.
std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection);

}  // namespace polynya::io
