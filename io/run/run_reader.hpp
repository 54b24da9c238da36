#pragma once

#include <deque>
#include <filesystem>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "geometry/shape/polygon.hpp"
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
  const ShapeParts* parts_of(simulation::FloeId floe) const;

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

}  // namespace polynya::io
