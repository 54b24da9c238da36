#include "io/run/run_writer.hpp"

#include <algorithm>
#include <fstream>
#include <unordered_map>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/pose.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/event_records.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using run_file::kGrowing;
enum : std::size_t { kFloes, kEvents, kFrames, kContacts, kCrushed, kStates, kForces, kPanels };
/// The buffers are written when they hold more than this [bytes].
constexpr std::size_t kMuchBuffered = std::size_t{256} << 10;
/// The buffers are also written after this time, so that a viewer of a running run sees its progress.
constexpr auto kLongestWait = std::chrono::seconds(1);

Motion motion_of(const simulation::FloeState& floe, geometry::Point centroid_in_body) {
  return {transform(floe.world_from_body, centroid_in_body), floe.angle, floe.velocity, floe.angular_velocity};
}

/// Writes final.geojson in parts, because it has a gigabyte for a million floes.
void write_floes(const simulation::Simulation& simulation, const std::optional<simulation::GeographicOrigin>& origin,
                 const WritePart& write) {
  constexpr std::size_t kPart = std::size_t{256} << 10;  // [bytes]
  GeojsonLayer layer(simulation.time(), place_members(origin));
  simulation.for_each_floe(simulation::Living::kFloating, [&](const simulation::FloeState& floe) {
    append_floe(layer, floe);
    if (layer.size() > kPart) write(layer.take());
  });
  write(layer.finish());
}

}  // namespace

Result<RunWriter> RunWriter::create(const std::filesystem::path& folder, bool overwrite, const LoadedScene& scene) {
  auto lock = claim_run_folder(folder, overwrite);
  if (!lock) return fail(lock.error());
  const auto written = write_whole_file(folder / run_file::kScene, scene.resolved_text, Durability::kSynced);
  if (!written) return fail(written.error());
  return begin(std::move(*lock), scene);
}

Result<RunWriter> RunWriter::begin(RunLock lock, const LoadedScene& scene) {
  if (const auto removed = remove_checkpoints(lock.folder()); !removed) return fail(removed.error());
  std::vector<OutputFile> files;
  for (const auto name : growing_files(scene.scene)) {
    auto file = OutputFile::create(lock.folder() / name);
    if (!file) return fail(file.error());
    files.push_back(std::move(*file));
  }
  RunWriter writer(scene, std::move(files), std::move(lock));
  for (std::size_t i = 0; i < writer.files_.size(); ++i) writer.file(i).append(header_of(kGrowing[i]));
  writer.flush();
  if (const auto status = writer.status(); !status) return fail(status.error());
  RunSummary first;
  first.stopped_by = "still running, or killed";
  first.peaks = writer.peaks_;
  const auto written =
      write_whole_file(writer.folder() / run_file::kSummary, to_json_text(first, scene), Durability::kSynced);
  if (!written) return fail(written.error());
  return writer;
}

namespace {

/// Fails if a growing file is shorter than at the checkpoint, so that it cannot be cut back to it.
Result<> check_size(const std::filesystem::path& file, std::uint64_t size_then) {
  std::error_code error;
  const auto status = std::filesystem::symlink_status(file, error);
  if (exists(status) && !is_regular_file(status)) return fail(file.string() + ": not a regular file");
  const auto size = std::filesystem::file_size(file, error);
  if (error) return fail(fmt::format("{}: {}", file.string(), error.message()));
  if (size >= size_then) return {};
  return fail(fmt::format("{}: {} bytes; at the checkpoint there were {}", file.string(), size, size_then));
}

/// Fails if a file does not begin with the header of this program, because rows with other columns could not be read
/// later.
Result<> check_header(const std::filesystem::path& file, std::string_view header) {
  std::string there(header.size(), '\0');
  std::ifstream stream(file, std::ios::binary);
  stream.read(there.data(), static_cast<std::streamsize>(there.size()));
  if (stream && there == header) return {};
  return fail(
      fmt::format("{}: its columns are those of another version of polynya, which can continue it", file.string()));
}

/// Returns the checksum of a file up to its size at a checkpoint. Fails if it differs from the checksum at the
/// checkpoint, so that nothing is appended to a damaged file.
Result<Checksum> checksum_then(const std::filesystem::path& file, const WrittenFile& then) {
  auto sum = checksum_of(file, then.size);
  if (!sum || sum->crc() == then.crc) return sum;
  return fail(
      fmt::format("{}: damaged since the checkpoint: its first {} bytes have the checksum {:08x}; they had {:08x}",
                  file.string(), then.size, sum->crc(), then.crc));
}

/// Returns the checksums of all growing files if the folder can be cut back to a checkpoint. It is called before any
/// file is changed.
Result<std::vector<Checksum>> check_progress(const RunProgress& progress, const std::filesystem::path& folder,
                                             const simulation::Scene& scene) {
  const auto is_of_scene = [columns = peak_columns(scene).size()](const ShipPeaks& peaks) {
    return peaks.of_column.size() == columns;
  };
  const std::size_t files = growing_files(scene).size();
  if (progress.files.size() != files || progress.peaks.size() != hull_count(scene) ||
      !std::ranges::all_of(progress.peaks, is_of_scene))
    return fail(fmt::format("{}: the checkpoint is of another run", folder.string()));
  for (std::size_t i = 0; i < files; ++i)
    if (auto checked = check_size(folder / kGrowing[i], progress.files[i].size); !checked) return fail(checked.error());
  std::vector<Checksum> sums;
  for (std::size_t i = 0; i < files; ++i) {
    const std::filesystem::path file = folder / kGrowing[i];
    if (auto checked = check_header(file, header_of(kGrowing[i])); !checked) return fail(checked.error());
    const auto sum = checksum_then(file, progress.files[i]);
    if (!sum) return fail(sum.error());
    sums.push_back(*sum);
  }
  return sums;
}

}  // namespace

Result<RunWriter> RunWriter::resume(RunLock lock, const LoadedScene& scene, const Checkpoint& checkpoint,
                                    const std::filesystem::path& file, const simulation::Simulation& simulation) {
  const RunProgress& progress = checkpoint.progress;
  const std::filesystem::path folder = lock.folder();
  const auto sums = check_progress(progress, folder, scene.scene);
  if (!sums) return fail(sums.error());
  Result<> ready = set_end(folder, scene);
  if (ready) ready = rewind_to(folder, checkpoint, file);
  if (!ready) return fail(ready.error());
  std::vector<OutputFile> files;
  for (std::size_t i = 0; i < sums->size(); ++i) {
    auto grown = OutputFile::reopen(folder / kGrowing[i], (*sums)[i]);
    if (!grown) return fail(grown.error());
    files.push_back(std::move(*grown));
  }
  RunWriter writer(scene, std::move(files), std::move(lock));
  writer.frames_ = FrameEncoder(progress.recorded);
  writer.peaks_ = progress.peaks;
  writer.has_begun_ = true;
  simulation.for_each_floe(simulation::Living::kAll, [&](const simulation::FloeState& floe) {
    writer.add_floe(floe.floe, floe.parent, geometry::measure(*floe.polygon_in_body).centroid);
  });
  return writer;
}

void RunWriter::add_floe(simulation::FloeId floe, simulation::FloeId parent, geometry::Point centroid_in_body) {
  const auto id = static_cast<std::size_t>(floe);
  if (id >= parents_.size()) {
    parents_.resize(id + 1, simulation::kNoFloe);
    centroids_in_body_.resize(id + 1);
  }
  parents_[id] = parent;
  centroids_in_body_[id] = centroid_in_body;
}

RunWriter::RunWriter(const LoadedScene& scene, std::vector<OutputFile> files, RunLock lock)
    : scene_(&scene),
      files_(std::move(files)),
      peak_columns_(peak_columns(scene.scene)),
      peaks_(hull_count(scene.scene)),
      lock_(std::move(lock)),
      last_flush_(std::chrono::steady_clock::now()) {
  for (std::size_t i = 0; i < peaks_.size(); ++i) {
    peaks_[i].ship = hull_of(scene.scene, i).name;
    peaks_[i].of_column.resize(peak_columns_.size());
  }
}

void RunWriter::record(simulation::Journal& journal) {
  std::unordered_map<simulation::FloeId, const geometry::Polygon*> broken;
  for (const simulation::Death& death : journal.deaths) broken[death.floe] = &death.polygon_in_body;
  for (const simulation::Birth& birth : journal.births) {
    add_floe(birth.floe, birth.parent, birth.centroid_in_body);
    const auto parent = broken.find(birth.parent);
    append(kFloes, [&](std::string& line) {
      append_birth(line, birth, parent != broken.end() ? parent->second : nullptr, &scene_->scene);
    });
    if (file(kFloes).buffered() > kMuchBuffered && !is_displaced_) file(kFloes).flush();
  }
  for (const simulation::Event& event : journal.events) {
    const simulation::IceEvent* ice = event.ice();
    append(kEvents, [&](std::string& line) {
      append_event(line, event, scene_->scene,
                   ice ? parents_[static_cast<std::size_t>(ice->floe)] : simulation::kNoFloe);
    });
    if (const auto* cut = std::get_if<simulation::RejectedCut>(&event.what))
      if (auto written = write_rejected_cut(folder(), event.time, *cut); status_) status_ = std::move(written);
  }
  for (const simulation::HullSample& sample : journal.samples) {
    append(kForces, [&](std::string& line) { append_forces_row(line, sample, scene_->scene); });
    std::vector<Peak>& peaks = peaks_[static_cast<std::size_t>(sample.ship)].of_column;
    for (std::size_t i = 0; i < peaks.size(); ++i) peaks[i].include(peak_columns_[i]->read(sample), sample.time);
  }
  for (const simulation::LoadPeak& peak : journal.peaks) {
    append(kContacts, [&](std::string& line) { append_contact(line, peak.time, peak.state, scene_->scene); });
    peaks_[static_cast<std::size_t>(peak.state.on.ship)].of_contact.include(peak.state.normal_force(), peak.time);
  }
  for (const simulation::PanelSample& sample : journal.panels)
    append(kPanels, [&](std::string& line) { append_panel(line, sample, scene_->scene); });
  journal.clear();
}

void RunWriter::frame(const simulation::Simulation& simulation) {
  std::vector<Motion> ships;
  for (const simulation::HullState& ship : simulation.ship_states()) {
    ships.push_back({ship.world_from_ship.position, ship.heading, ship.velocity, ship.angular_velocity});
  }
  has_begun_ = true;
  frames_.begin(simulation.time(), ships);
  simulation.for_each_floe(simulation::Living::kAll, [&](const simulation::FloeState& floe) {
    frames_.add({floe.floe, motion_of(floe, centroids_in_body_[static_cast<std::size_t>(floe.floe)])});
  });
  file(kFrames).append(frames_.end());
  append(kContacts, [&](std::string& lines) {
    for (const simulation::ContactState& contact : simulation.contact_states())
      append_contact(lines, simulation.time(), contact, scene_->scene);
  });
  append(kCrushed, [&](std::string& lines) {
    for (const simulation::CrushedOverlap& overlap : simulation.crushed_overlaps())
      if (overlap.share >= kLeastCrushedShare) append_crushed(lines, simulation.time(), overlap, scene_->scene);
  });
  append(kStates, [&](std::string& line) {
    append_state(line, simulation.time(), simulation.counts().steps, simulation.state_hash());
  });
}

Result<> RunWriter::sync_files() {
  flush();
  static_cast<void>(std::ranges::all_of(files_, &OutputFile::sync));
  return status();
}

Result<RunProgress> RunWriter::sync() {
  if (const auto synced = sync_files(); !synced) return fail(synced.error());
  RunProgress progress;
  for (const OutputFile& file : files_) progress.files.push_back({file.size(), file.checksum().crc()});
  progress.recorded = frames_.recorded();
  progress.peaks = peaks_;
  return progress;
}

void RunWriter::flush() {
  check_place();
  bool is_sound = !is_displaced_;
  for (OutputFile& file : files_) {
    if (!is_sound) file.drop();  // other files must not name a record that could not be written
    is_sound = is_sound && file.flush();
  }
  last_flush_ = std::chrono::steady_clock::now();
}

void RunWriter::check_place() {
  if (is_displaced_) return;
  const auto lost = std::ranges::find_if_not(files_, &OutputFile::is_in_place);
  is_displaced_ = !lock_.is_in_place() || lost != files_.end();
  if (!is_displaced_ || !status_) return;
  status_ = fail(fmt::format("{}: removed, moved or replaced by another program during the run",
                             lock_.is_in_place() ? lost->name() : folder().string()));
}

void RunWriter::flush_if_due() {
  std::size_t buffered = 0;
  for (const OutputFile& file : files_) buffered += file.buffered();
  if (buffered > kMuchBuffered || std::chrono::steady_clock::now() - last_flush_ > kLongestWait) flush();
}

Result<> RunWriter::status() const {
  Result<> status = status_;
  for (const OutputFile& file : files_)
    if (status) status = file.status();
  return status;
}

std::vector<std::string> RunWriter::overlong(std::uint64_t longest) const {
  std::vector<std::string> names;
  for (std::size_t i = 0; i < files_.size(); ++i)
    if (files_[i].size() + files_[i].buffered() > longest) names.emplace_back(kGrowing[i]);
  return names;
}

Result<> RunWriter::write_checksums(Checksums known) const {
  for (std::size_t i = 0; i < files_.size(); ++i) known[std::string(kGrowing[i])] = files_[i].checksum();
  std::vector<std::filesystem::path> others{run_file::kScene};
  std::error_code ignored;  // there is no such folder if no cut was refused
  for (const auto& entry : std::filesystem::directory_iterator(folder() / run_file::kRejectedCuts, ignored))
    others.push_back(std::filesystem::path(run_file::kRejectedCuts) / entry.path().filename());
  for (const std::filesystem::path& path : checkpoints_in(folder())) others.push_back(path.filename());
  if (std::filesystem::exists(folder() / run_file::kFailure)) others.emplace_back(run_file::kFailure);
  for (const std::filesystem::path& name : others) {
    const auto sum = checksum_of(folder() / name);
    if (!sum) return fail(sum.error());
    known[name.string()] = *sum;
  }
  return io::write_checksums(folder(), known);
}

Result<> RunWriter::finish(const RunSummary& summary, const simulation::Simulation* simulation) {
  Result<> written = sync_files();
  if (is_displaced_) return written;  // the folder or a file now belongs to another program and must not be changed
  Checksums sums;
  const auto write = [&](std::string_view name, const std::function<void(const WritePart&)>& produce) {
    Checksum& sum = sums[std::string(name)];
    const auto write_and_add = [&](const WritePart& part) {
      produce([&](std::string_view text) {
        sum.add(text);
        part(text);
      });
    };
    auto done = write_whole_file_in_parts(folder() / name, write_and_add, Durability::kSynced);
    if (written) written = std::move(done);
  };
  const auto write_ice = [&] {
    if (simulation)
      write(run_file::kFinalGeojson,
            [&](const WritePart& part) { write_floes(*simulation, scene_->scene.origin, part); });
  };
  // The summary of a finished run is written last, when the disk has stored all other files. For a run that was stopped
  // it is written first, because it matters more than the ice if the disk is nearly full.
  if (summary.finished) write_ice();
  if (summary.finished && written) written = announce_checksums(folder());
  if (written || !summary.finished)
    write(run_file::kSummary, [&](const WritePart& part) { part(to_json_text(summary, *scene_)); });
  if (!summary.finished) write_ice();
  if (summary.finished && written) written = remove_checkpoints(folder(), 1);
  if (summary.finished && written) written = write_checksums(std::move(sums));
  return written;
}

}  // namespace polynya::io
