#include "browser/module/session.hpp"

#include <chrono>

#include <fmt/format.h>

#include "io/run/available_memory.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_reader.hpp"
#include "io/scene/scene_file.hpp"
#include "io/text/json_writer.hpp"
#include "simulation/world/memory_estimate.hpp"
#include "simulation/world/world.hpp"
#include "views/player/player_page.hpp"

namespace polynya::browser {
namespace {

void write_ships(io::JsonWriter& json, const simulation::Scene& scene) {
  json.key("hulls").open('[');
  for (std::size_t hull = 0; hull < hull_count(scene); ++hull) {
    const bool is_ship = hull < scene.ships.size();
    const auto* engine = is_ship ? std::get_if<simulation::Engine>(&scene.ships[hull].propulsion) : nullptr;
    json.object([&] {
      json.key("name").value(hull_of(scene, hull).name).key("waterline_m").value(hull_of(scene, hull).hull.waterline);
      json.key("can_be_steered").value(engine != nullptr);
    });
  }
  json.close(']').key("force_columns").open('[');
  for (const io::ForceColumn* column : io::plotted_columns(scene)) {
    json.object([&] {
      json.key("name").value(column->name).key("unit").value(column->unit);
      json.key("plot").value(column->plot).key("curve").value(column->curve);
    });
  }
  json.close(']');
}

/// Returns the data of a scene that the page shows after reading it.
std::string words_of(const io::LoadedScene& scene) {
  std::string text;
  io::JsonWriter json(text);
  const simulation::MemoryEstimate memory = estimate_memory(scene.scene);
  json.open('{').key("name").value(scene.scene.name).key("description").value(scene.description);
  json.key("until_s").value(scene.scene.time.until).key("step_s").value(scene.scene.time.step);
  json.key("floes").value(scene.scene.floes.size()).key("memory_bytes").value(memory.all_moving);
  json.key("limit_bytes").value(io::memory_available().bytes).key("ships").value(scene.scene.ships.size());
  json.key("memory_at_start_bytes").value(memory.at_start).key("hash").value(scene.hash);
  json.key("forces_interval_s").value(recording_interval(scene.scene));
  json.key("splits_by_j_over_tau_c").value(splits_by_j_over_tau_c(scene.scene));
  write_ships(json, scene.scene);
  json.close('}');
  text.pop_back();
  text += ",\"options\":" + views::scene_plan(scene, "", "") + ",\"hints\":" + to_json_text(scene.hints) + "}";
  return text;
}

}  // namespace

bool Session::load(std::string text) {
  io::SceneOutcome read = io::read_scene(std::move(text), "scene.json", "/");
  if (!read) {
    words_ = to_json_text(read.error());
    return false;
  }
  recorder_.reset();
  run_.reset();
  snapshot_ = {};
  scene_ = std::move(*read);
  words_ = words_of(*scene_);
  return true;
}

bool Session::start() {
  recorder_.reset();
  run_.reset();
  snapshot_ = {};
  progress_ = Progress::kRunning;
  if (!scene_) return words_ = "there is no scene", false;
  auto started = io::start_run(kRunFolder, *scene_, /*overwrite=*/true);
  if (!started) return words_ = started.error(), false;
  run_.emplace(std::move(*started));
  recorder_ = std::make_unique<io::RunRecorder>(run_->simulation, run_->writer, *scene_);
  snapshot_.gather(run_->simulation.journal(), scene_->scene);
  recorder_->begin(run_->simulation.journal());
  return true;
}

/// Takes one step. Returns false if the run cannot continue after it.
bool Session::step() {
  simulation::Simulation& simulation = run_->simulation;
  simulation.step();
  snapshot_.gather(simulation.journal(), scene_->scene);
  recorder_->record_step();
  if (auto failure = simulation.numerical_failure()) {
    words_ = *std::move(failure);
    progress_ = Progress::kNumericalFailure;
  } else {
    recorder_->frame_if_due();
  }
  return progress_ == Progress::kRunning;
}

Progress Session::advance(double until, double wall) {
  if (!run_ || progress_ != Progress::kRunning) return progress_;
  using Clock = std::chrono::steady_clock;
  const auto end = Clock::now() + std::chrono::duration<double>(wall);
  const std::int64_t last = io::last_step_of(scene_->scene.time);
  simulation::Simulation& simulation = run_->simulation;
  while (simulation.steps() < last && simulation.time() < until - 1e-9) {
    if (!step()) return progress_;
    if (Clock::now() >= end) break;
  }
  run_->writer.flush_if_due();
  if (const auto status = run_->writer.status(); !status) {
    words_ = status.error();
    return progress_ = Progress::kFolderFailure;
  }
  return simulation.steps() >= last ? Progress::kFinished : Progress::kRunning;
}

bool Session::advance_beyond(double until) {
  while (run_ && run_->simulation.time() < until - 1e-9)
    if (!step()) return false;
  return run_.has_value();
}

void Session::steer(int ship, simulation::Command command) {
  if (run_) run_->simulation.set_pilot(ship, [command](const simulation::PilotView&) { return command; });
}

void Session::release(int ship) {
  if (run_) run_->simulation.set_pilot(ship, {});
}

void Session::take_snapshot() {
  const simulation::Simulation& simulation = run_->simulation;
  const views::ColumnWriter columns = snapshot_.take(simulation);
  const simulation::Counts counts = simulation.counts();
  words_.clear();
  io::JsonWriter json(words_);
  json.open('{').key("t_s").value(simulation.time()).key("steps").value(simulation.steps());
  json.key("bends").value(counts.bends).key("splits").value(counts.splits).key("ground").value(counts.ground);
  json.key("columns").objects(columns.table(), [&](const views::ColumnWriter::Column& column) {
    json.key("name").value(column.name).key("type").value(column.type);
    json.key("offset").value(column.offset).key("count").value(column.count);
  });
  json.close('}');
  columns_ = columns.bytes();
}

bool Session::finish(const std::string& reason) {
  if (!run_) return false;
  const bool is_failure = progress_ == Progress::kNumericalFailure;
  auto written = reason.empty() ? recorder_->end() : is_failure ? io::Result<>{} : recorder_->checkpoint();
  const io::RunSummary summary = summarise(run_->simulation, run_->writer, reason, recorder_->wall_time());
  const bool has_floes = scene_->scene.floes.size() <= io::kMostFloesInFinal;
  if (written) written = run_->writer.finish(summary, has_floes ? &run_->simulation : nullptr);
  if (!written) words_ = written.error();
  return written.has_value();
}

bool Session::read_back() {
  const auto run = io::read_run(kRunFolder);
  if (!run) return words_ = run.error(), false;
  views::PlayerData data = views::player_data(*run, {});
  words_ = std::move(data.info);
  columns_ = data.columns.bytes();
  return true;
}

std::string Session::state_hash() const {
  return run_ ? fmt::format("{:016x}", run_->simulation.state_hash()) : std::string();
}

}  // namespace polynya::browser
