#include "io/run/run_reader.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

#include "io/run/event_records.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/summary.hpp"
#include "io/scene/scene_file.hpp"

namespace polynya::io {

using geometry::Polygon;
using simulation::FloeId;

namespace {
/// Number of vertices of assembled shapes that are kept, 64 MB.
constexpr std::size_t kMostKept = std::size_t{4} << 20;
}  // namespace

void FloeShapes::add(ShapeParts shape, FloeId parent) {
  Floe floe;
  floe.ring_sizes = ring_sizes(shape);
  if (shape.has_parent()) {
    if (parent < 0 || static_cast<std::size_t>(parent) >= floes_.size())
      throw ReadError("parts of a parent that is not on a line before");
    check_parts(shape, floes_[static_cast<std::size_t>(parent)].ring_sizes);
    floe.parent = parent;
    floe.parts = std::move(shape);
  } else {
    floe.whole = std::make_shared<const Polygon>(assembled(shape, {}));
  }
  floes_.push_back(std::move(floe));
}

std::shared_ptr<const Polygon> FloeShapes::find(FloeId id) const {
  if (floe(id).whole) return floe(id).whole;
  const auto found = kept_.find(id);
  return found != kept_.end() ? found->second : nullptr;
}

void FloeShapes::keep(FloeId id, std::shared_ptr<const Polygon> shape) const {
  kept_vertices_ += vertex_count(*shape);
  kept_[id] = std::move(shape);
  oldest_kept_.push_back(id);
  while (kept_vertices_ > kMostKept && oldest_kept_.size() > 1) {
    const auto oldest = kept_.find(oldest_kept_.front());
    kept_vertices_ -= vertex_count(*oldest->second);
    kept_.erase(oldest);
    oldest_kept_.pop_front();
  }
}

std::shared_ptr<const Polygon> FloeShapes::of(FloeId id) const {
  std::vector<FloeId> missing;
  std::shared_ptr<const Polygon> shape = find(id);
  for (FloeId at = id; !shape; shape = find(at)) {
    missing.push_back(at);
    at = floe(at).parent;
  }
  for (; !missing.empty(); missing.pop_back()) {
    shape = std::make_shared<const Polygon>(assembled(floe(missing.back()).parts, *shape));
    keep(missing.back(), shape);
  }
  return shape;
}

namespace {

std::string text_of(const std::filesystem::path& folder, std::string_view name) {
  auto text = read_text_file(folder / name, kLongestRunFile);
  if (!text) throw ReadError(fmt::format("{}: {}", (folder / name).string(), text.error()));
  return std::move(*text);
}

JsonValue summary_of(const std::filesystem::path& folder, const LoadedScene& scene) {
  const std::string text = text_of(folder, run_file::kSummary);
  const std::string path = (folder / run_file::kSummary).string();
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) throw ReadError(fmt::format("{}:{}", path, first_fault(document, text)));
  if (const auto fault = fault_of_summary(document.root, scene)) {
    const LineAndColumn at = line_and_column(text, fault->offset);
    throw ReadError(fmt::format("{}:{}:{}: {}: {}", path, at.line, at.column, fault->path, message_of(*fault)));
  }
  return std::move(document.root);
}

bool is_finished(const Run& run) {
  const JsonValue* finished = run.summary.find("finished", JsonValue::Kind::kBoolean);
  return finished && finished->boolean();
}

/// Calls use(line, number) for each whole line of a file. Behind the last line break a killed run may leave part of a
/// line, which is ignored; in a finished run that is an error.
template <class Use>
void for_lines(const Run& run, std::string_view name, Use use) {
  const std::filesystem::path path = run.folder / name;
  const std::string text = text_of(run.folder, name);
  int number = 0;
  const auto place = [&](std::string_view words) { return fmt::format("{}:{}: {}", path.string(), number, words); };
  for_pieces(std::string_view(text).substr(0, text.rfind('\n') + 1), '\n', [&](std::string_view line, std::size_t) {
    try {
      ++number;
      use(line, number);
    } catch (const ReadError& error) {
      throw ReadError(place(printable(error.what())));
    }
  });
  ++number;
  if (is_finished(run) && !text.empty() && text.back() != '\n')
    throw ReadError(place("the last line is cut short, of a run that finished"));
}

/// Calls use_header(line) for the first line of a table and use(line) for each row. Throws ReadError if a row does not
/// have as many fields as the header.
template <class UseHeader, class Use>
void for_rows(const Run& run, std::string_view name, UseHeader use_header, Use use) {
  std::ptrdiff_t commas = -1;
  for_lines(run, name, [&](std::string_view line, int) {
    const std::ptrdiff_t here = std::ranges::count(line, ',');
    if (commas < 0) {
      commas = here;
      return use_header(line);
    }
    if (here != commas) throw ReadError(fmt::format("{} fields below a header of {}", here + 1, commas + 1));
    use(line);
  });
  if (commas < 0) throw ReadError(fmt::format("{}: empty, without its header", (run.folder / name).string()));
}

/// Calls use(line) for each row of a table that may be missing, because earlier versions did not write it. The header
/// must be that of this version or its beginning, because earlier versions had fewer columns.
template <class Use>
bool for_rows_where_recorded(const Run& run, std::string_view name, Use use) {
  if (!exists(std::filesystem::symlink_status(run.folder / name))) return false;
  const auto check_header = [header = header_of(name)](std::string_view line) {
    if (!header.starts_with(line)) throw ReadError("columns of another version");
  };
  for_rows(run, name, check_header, use);
  return true;
}

void check_version(const Run& run) {
  const JsonValue* found = run.summary.find("folder_version");
  if (!found) return;
  const double version = found->is(JsonValue::Kind::kNumber) ? found->number() : std::nan("");
  if (!(version <= kRunFolderVersion))
    throw ReadError(fmt::format("{}: a run folder of version {}; this program reads up to {}",
                                (run.folder / run_file::kSummary).string(), version, kRunFolderVersion));
}

void read_floes(Run& run) {
  for_lines(run, run_file::kFloes, [&](std::string_view line, int) {
    const JsonValue json = json_of(line);
    simulation::BirthRecord birth = birth_of(json);
    if (const RunFloe* parent = run.floe(birth.parent))
      birth.own_ice = parent->birth.own_ice;
    else if (birth.floe < std::ssize(run.scene.scene.floes))
      birth.own_ice = run.scene.scene.floes[static_cast<std::size_t>(birth.floe)].own_ice;
    if (birth.floe != static_cast<FloeId>(run.floes.size())) throw ReadError("floes are not in the order of their ids");
    run.shapes.add(read_shape(json), birth.parent);
    run.floes.push_back({.birth = birth, .death_event = {}});
  });
}

/// Marks ice that surfaced from under a hull, and all pieces into which it breaks, as brash.
void mark_brash(Run& run, const simulation::Event& event) {
  const bool came_up = event.is<simulation::Resurface>() || run.floe(event.ice()->floe)->came_up;
  for (const FloeId child : event.ice()->children) {
    if (run.floe(child)) run.floes[static_cast<std::size_t>(child)].came_up = came_up;
  }
}

void read_events(Run& run) {
  for_lines(run, run_file::kEvents, [&](std::string_view line, int) {
    const simulation::Event& event = run.events.emplace_back(event_of(json_of(line), run.scene.scene));
    if (!event.ice()) return;
    const FloeId id = event.ice()->floe;
    if (!run.floe(id)) throw ReadError(fmt::format("floe {} was never born", id));
    RunFloe& floe = run.floes[static_cast<std::size_t>(id)];
    if (event.is<simulation::Submerge>()) floe.went_under = event.time;
    if (event.ends_floe()) {
      floe.died = event.time;
      floe.death_event = run.events.size() - 1;
    }
    mark_brash(run, event);
  });
}

void read_forces(Run& run) {
  std::vector<const ForceColumn*> columns;
  const auto read_header = [&](std::string_view line) {
    auto found = force_columns_in(line);
    if (!found) throw ReadError(found.error());
    columns = std::move(*found);
  };
  for_rows(run, run_file::kForces, read_header,
           [&](std::string_view line) { run.samples.push_back(sample_of(line, columns, run.scene.scene)); });
}

/// Reads contacts.csv. A peak is a row at the end of its contact.
void read_contacts(Run& run) {
  for_rows_where_recorded(run, run_file::kContacts, [&](std::string_view line) {
    RunContact contact = contact_of(line, run);
    const bool is_peak = contact.state.ended_by != simulation::PeakEnd::kNone;
    (is_peak ? run.peaks : run.contacts).push_back(contact);
  });
  std::ranges::stable_sort(run.peaks, {}, &RunContact::time);
}

void read_frames(Run& run) {
  const std::filesystem::path path = run.folder / run_file::kFrames;
  auto frames = decode_frames(text_of(run.folder, run_file::kFrames), is_finished(run));
  if (!frames) throw ReadError(fmt::format("{}: {}", path.string(), frames.error()));
  run.frames = std::move(*frames);
  const std::size_t hulls = hull_count(run.scene.scene);
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    const auto refuse = [&](const std::string& what) {
      throw ReadError(fmt::format("{}: frame {}: {}", path.string(), i + 1, what));
    };
    const Frame& frame = run.frames[i];
    if (i > 0 && frame.time <= run.frames[i - 1].time)
      refuse(fmt::format("at {} s, not after the one before, at {} s", frame.time, run.frames[i - 1].time));
    if (frame.ships.size() != hulls)
      refuse(fmt::format("{} ships and structures, where the scene has {}", frame.ships.size(), hulls));
    for (const FloeMotion& floe : frame.floes)
      if (!run.floe(floe.floe)) refuse(fmt::format("floe {} was never born", floe.floe));
  }
}

/// Checks panels.csv and states.csv, which only commands in Python use.
void check_other_tables(const Run& run) {
  for_rows_where_recorded(run, run_file::kPanels, [&](std::string_view line) { panel_of(line, run.scene.scene); });
  for_rows_where_recorded(run, run_file::kStates, [&](std::string_view line) { check_state(line); });
}

/// Returns the reason why a folder without a scene is not the folder of a run.
std::string what_is_missing(const std::filesystem::path& folder) {
  std::error_code error;
  const auto status = std::filesystem::status(folder, error);
  if (!exists(status)) return "does not exist";
  return is_directory(status) ? fmt::format("has no {}", run_file::kScene) : "is a file";
}

}  // namespace

std::vector<FloeId> Run::lineage(FloeId id) const {
  std::vector<FloeId> ids;
  while (const RunFloe* at = floe(id)) {
    ids.push_back(id);
    if (at->birth.parent >= id) break;  // a parent always has a smaller id; stops on a damaged file
    id = at->birth.parent;
  }
  std::ranges::reverse(ids);
  return ids;
}

std::span<const RunContact> Run::contacts_at(double time) const {
  const auto first = std::ranges::lower_bound(contacts, time, {}, &RunContact::time);
  const auto last = std::ranges::upper_bound(contacts, time, {}, &RunContact::time);
  return {first, last};
}

Result<Run> read_run(const std::filesystem::path& folder) {
  try {
    Run run;
    run.folder = folder;
    if (std::error_code error; !std::filesystem::is_regular_file(folder / run_file::kScene, error))
      return fail(fmt::format("not a run folder: {} {}", folder.string(), what_is_missing(folder)));
    auto scene = read_scene_file(folder / run_file::kScene);
    if (!scene) return fail(to_string(scene.error().front()));
    run.scene = std::move(*scene);
    run.label = run.scene.scene.name;
    run.summary = summary_of(folder, run.scene);
    check_version(run);
    read_floes(run);
    read_events(run);
    read_forces(run);
    read_contacts(run);
    run.has_crushed = for_rows_where_recorded(
        run, run_file::kCrushed, [&](std::string_view line) { run.crushed.push_back(crushed_of(line, run)); });
    read_frames(run);
    check_other_tables(run);
    return run;
  } catch (const ReadError& error) {
    return fail(error.what());
  }
}

geometry::Polygon polygon_in_world(geometry::Polygon polygon, geometry::Point centroid_in_body, const Motion& motion) {
  const geometry::Rotation rotation = geometry::Rotation::by(motion.angle);
  const auto place = [&](geometry::Ring& points) {
    for (geometry::Point& p : points) p = motion.position + rotate(rotation, p - centroid_in_body);
  };
  place(polygon.outer);
  std::ranges::for_each(polygon.holes, place);
  return polygon;
}

MotionIndex::MotionIndex(const Run& run) : floes_(run.floes.size()), ships_(hull_count(run.scene.scene)) {
  for (const Frame& frame : run.frames) {
    frame_times_.push_back(frame.time);
    for (const FloeMotion& floe : frame.floes) {
      const auto id = static_cast<std::size_t>(floe.floe);
      if (id < floes_.size()) floes_[id].push_back({frame.time, floe.motion});
    }
    for (std::size_t i = 0; i < std::min(ships_.size(), frame.ships.size()); ++i) ships_[i].push_back(frame.ships[i]);
  }
}

const RecordedMotion* MotionIndex::last_record(FloeId floe, double time) const {
  const auto& records = floes_[static_cast<std::size_t>(floe)];
  if (records.empty()) return nullptr;
  const auto after = std::ranges::upper_bound(records, time, {}, &RecordedMotion::time);
  return after == records.begin() ? &records.front() : &*(after - 1);
}

namespace {

Motion between(const Motion& a, const Motion& b, double part) {
  const auto mix = [&](double from, double to) { return from + part * (to - from); };
  return {{mix(a.position.x, b.position.x), mix(a.position.y, b.position.y)},
          mix(a.angle, b.angle),
          {mix(a.velocity.x, b.velocity.x), mix(a.velocity.y, b.velocity.y)},
          mix(a.angular_velocity, b.angular_velocity)};
}

}  // namespace

std::optional<Motion> MotionIndex::floe_at(FloeId floe, double time) const {
  if (floe < 0 || static_cast<std::size_t>(floe) >= floes_.size()) return std::nullopt;
  const RecordedMotion* last = last_record(floe, time);
  if (!last) return std::nullopt;
  const Motion carried = carried_on(last->motion, time - last->time);
  const auto next_frame = std::ranges::upper_bound(frame_times_, time);
  if (next_frame == frame_times_.end() || next_frame == frame_times_.begin() || last->time > time) return carried;
  const RecordedMotion* next = last_record(floe, *next_frame);
  if (next == last) return carried;
  const double start = *(next_frame - 1);
  const double part = (time - start) / (*next_frame - start);
  return between(carried_on(last->motion, start - last->time), next->motion, part);
}

std::optional<Motion> MotionIndex::ship_at(std::size_t ship, double time) const {
  if (ship >= ships_.size() || ships_[ship].empty()) return std::nullopt;
  const auto& motions = ships_[ship];
  const auto next = static_cast<std::size_t>(std::ranges::upper_bound(frame_times_, time) - frame_times_.begin());
  if (next == 0) return motions.front();
  if (next >= motions.size()) return carried_on(motions.back(), time - frame_times_[motions.size() - 1]);
  const double start = frame_times_[next - 1];
  return between(motions[next - 1], motions[next], (time - start) / (frame_times_[next] - start));
}

std::vector<Frame> thinned_frames(const Run& run, const FrameSelection& selection) {
  if (selection.is_all()) return run.frames;
  std::map<simulation::FloeId, RecordedMotion> skipped;  // records since the last selected frame
  std::vector<Frame> frames;
  std::size_t last = 0;  // index one past the last selected frame
  for (std::size_t i = 0; i < run.frames.size(); ++i) {
    if (selection.has(run.frames[i].time)) last = i + 1;
  }
  int selected = 0;
  for (std::size_t i = 0; i < last; ++i) {
    const Frame& frame = run.frames[i];
    for (const FloeMotion& floe : frame.floes) skipped[floe.floe] = {frame.time, floe.motion};
    if (!selection.has(frame.time)) continue;
    if (selected++ % selection.every != 0 && i + 1 != last) continue;
    Frame kept{.time = frame.time, .ships = frame.ships, .floes = {}};
    for (const auto& [floe, at] : skipped) {
      if (run.is_alive(floe, frame.time) || run.is_under(floe, frame.time))
        kept.floes.push_back({floe, carried_on(at.motion, frame.time - at.time)});
    }
    skipped.clear();
    frames.push_back(std::move(kept));
  }
  return frames;
}

geometry::Pose pose_of(const simulation::BirthRecord& birth, const Motion& motion) {
  const geometry::Rotation rotation = geometry::Rotation::by(motion.angle);
  return {motion.position - rotate(rotation, birth.centroid_in_body - geometry::Point{}), rotation};
}

namespace {

/// Returns the pose of the floe, or of the youngest floe in its lineage that a frame has.
geometry::Pose body_pose(const Run& run, const MotionIndex& motions, const simulation::BirthRecord& floe, double time) {
  const simulation::BirthRecord* at = &floe;
  while (true) {
    if (const auto motion = motions.floe_at(at->floe, time)) return pose_of(*at, *motion);
    const RunFloe* parent = at->parent < at->floe ? run.floe(at->parent) : nullptr;
    if (!parent) return {};
    at = &parent->birth;
  }
}

PlacedFloe placed(const Run& run, const MotionIndex& motions, const simulation::BirthRecord& floe, double time) {
  return {&floe, run.shape(floe.floe), body_pose(run, motions, floe, time), motions.floe_at(floe.floe, time)};
}

}  // namespace

void for_floes_at(const Run& run, const MotionIndex& motions, double time,
                  const std::function<void(const PlacedFloe&)>& use) {
  for (const RunFloe& floe : run.floes)
    if (run.is_alive(floe.birth.floe, time)) use(placed(run, motions, floe.birth, time));
}

std::vector<PlacedFloe> floes_at(const Run& run, const MotionIndex& motions, double time) {
  std::vector<PlacedFloe> floes;
  for_floes_at(run, motions, time, [&](const PlacedFloe& floe) { floes.push_back(floe); });
  return floes;
}

std::vector<PlacedFloe> floes_under_hulls_at(const Run& run, const MotionIndex& motions, double time) {
  std::vector<PlacedFloe> floes;
  for (const RunFloe& floe : run.floes)
    if (run.is_under(floe.birth.floe, time)) floes.push_back(placed(run, motions, floe.birth, time));
  return floes;
}

geometry::Pose ship_pose_at(const Run& run, const MotionIndex& motions, std::size_t ship, double time) {
  if (const auto motion = motions.ship_at(ship, time)) return {motion->position, geometry::Rotation::by(motion->angle)};
  const simulation::PlacedHull& hull = hull_of(run.scene.scene, ship);
  return {hull.position_in_world, geometry::Rotation::by(hull.heading)};
}

std::vector<double> frame_times_until(const Run& run, double time) {
  std::vector<double> times;
  for (const Frame& frame : run.frames) {
    if (frame.time < time) times.push_back(frame.time);
  }
  times.push_back(time);
  return times;
}

}  // namespace polynya::io
