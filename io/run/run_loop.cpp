#include "io/run/run_loop.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "simulation/state/state.hpp"
#include "simulation/world/world.hpp"

namespace polynya::io {

using simulation::Simulation;

Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite) {
  Simulation simulation(scene.scene);
  auto writer = RunWriter::create(folder, overwrite, scene);
  if (!writer) return fail(writer.error());
  return ActiveRun{scene, std::move(simulation), std::move(*writer)};
}

std::int64_t last_step_of(const simulation::StepSettings& time) {
  return static_cast<std::int64_t>(std::ceil(time.until / time.step - 1e-9));
}

Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file) {
  auto checkpoint = read_checkpoint_file(file, scene.course_hash);
  if (!checkpoint) return fail(checkpoint.error());
  const simulation::StepSettings& time = scene.scene.time;
  if (checkpoint->steps > last_step_of(time))
    return fail(fmt::format("{}: at {:.6g} s, after the end of the run at {:.6g} s", file.string(),
                            static_cast<double>(checkpoint->steps) * time.step, time.until));
  auto simulation = simulation_at(scene, *checkpoint);
  if (!simulation) return fail(fmt::format("{}: {}", file.string(), simulation.error()));
  const auto finished = finished_run(lock.folder());
  auto writer = RunWriter::resume(std::move(lock), scene, *checkpoint, file, *simulation);
  if (!writer) return fail(writer.error());
  return ActiveRun{scene, std::move(*simulation), std::move(*writer),
                   finished ? finished->wall_time : checkpoint->wall_time};
}

Result<Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint) {
  auto simulation = Simulation::resumed(scene.scene, checkpoint.state);
  if (!simulation) return fail("damaged: " + simulation.error());
  if (simulation->steps() != checkpoint.steps || simulation->state_hash() != checkpoint.state_hash)
    return fail("damaged: its state is not the one that was saved");
  return simulation;
}

Checkpoint checkpoint_of(const Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time) {
  return {.program_version = std::string(version()),
          .course_hash = scene.course_hash,
          .steps = simulation.steps(),
          .wall_time = wall_time,
          .progress = std::move(progress),
          .state = simulation.state(),
          .state_hash = simulation.state_hash(),
          .failure = ""};
}

namespace {

std::optional<std::string> numerical_failure_of(const Simulation& simulation) {
  auto failure = simulation.numerical_failure();
  return failure ? std::optional("numerical failure: " + *failure) : std::nullopt;
}

}  // namespace

std::optional<std::string> failure_after_step(const Simulation& simulation) {
  if (auto failure = numerical_failure_of(simulation)) return failure;
  if (!simulation.audit().is_closed()) return "the balances of energy or momentum do not close";
  if (auto wrong = validate_world(simulation.world())) return "the state is inconsistent: " + *wrong;
  return {};
}

namespace {

/// Returns the run at its newest checkpoint that can be read and has no failure, or at its start.
Simulation at_last_checkpoint(const ActiveRun& run) {
  for (const auto& path : checkpoints_in(run.writer.folder())) {
    const auto checkpoint = read_checkpoint_file(path, run.scene.course_hash);
    if (!checkpoint || checkpoint->steps >= run.simulation.steps()) continue;
    auto there = Simulation::resumed(run.scene.scene, checkpoint->state);
    if (there && !failure_after_step(*there)) return std::move(*there);
  }
  return Simulation(run.scene.scene);
}

/// Writes a dump into the run folder: the state before the first step after which a failure is found, and the failure.
/// The step is found by stepping again from the newest checkpoint without a failure. This way the normal run needs no
/// extra work.
Result<> dump_failure(const ActiveRun& run) {
  const auto step = [](Simulation& simulation) {
    simulation.step();
    simulation.journal().clear();
  };
  Simulation ahead = at_last_checkpoint(run);
  Simulation before = at_last_checkpoint(run);
  std::optional<std::string> failure;
  std::int64_t last_sound = before.steps();
  while (!failure && ahead.steps() < run.simulation.steps()) {
    last_sound = ahead.steps();
    step(ahead);
    failure = failure_after_step(ahead);
  }
  if (!failure) return fail("it did not come again");
  while (before.steps() < last_sound) step(before);
  before.journal().clear();
  Checkpoint dump = checkpoint_of(before, run.scene, {}, 0);
  dump.failure = *failure;
  return write_checkpoint_file(run.writer.folder() / run_file::kFailure, dump);
}

constexpr std::int64_t kStepsBetweenReports = 16;  ///< reading the clock takes as long as a small step

}  // namespace

RunRecorder::RunRecorder(Simulation& simulation, RunWriter& writer, const LoadedScene& scene, double wall_time)
    : simulation_(simulation), writer_(writer), scene_(scene), wall_time_before_(wall_time) {}

void RunRecorder::begin(simulation::Journal& journal) {
  writer_.record(journal);
  writer_.frame(simulation_);
}

Result<> RunRecorder::checkpoint(double wall_time) {
  auto progress = writer_.sync();
  if (!progress) return fail(progress.error());
  auto written =
      write_checkpoint(writer_.folder(), checkpoint_of(simulation_, scene_, std::move(*progress), wall_time));
  last_checkpoint_ = Clock::now();
  return written;
}

bool RunRecorder::is_frame_due() const {
  return is_due(simulation_.world().clock, scene_.scene.record.frames_interval);
}

Result<> RunRecorder::end() {
  auto written = checkpoint(0);  // The wall time is left out, so that two folders of the same run have the same bytes.
  if (written && !is_frame_due()) writer_.frame(simulation_);
  return written;
}

namespace {

/// Reason why a run ends before its scene does.
struct Stop {
  RunEnd end = RunEnd::kFinished;
  std::string reason;
};

std::optional<Stop> stop_where_failed(const Result<>& written) {
  if (written) return {};
  return Stop{RunEnd::kFolderFailure, written.error()};
}

class RunLoop {
 public:
  RunLoop(ActiveRun& run, const RunControl& control)
      : run_(run), control_(control), recorder_(run.simulation, run.writer, run.scene, run.wall_time) {
    const simulation::StepSettings& time = run.scene.scene.time;
    last_step_ = last_step_of(time);
  }

  /// Steps to the end of the run. Returns nothing if the end was reached.
  std::optional<Stop> advance() {
    simulation().set_threads(control_.threads);
    if (!run_.writer.has_begun()) recorder_.begin(simulation().journal());
    while (simulation().steps() < last_step_)
      if (auto stop = advance_step()) return stop;
    return stop_where_failed(recorder_.end());
  }

  RunResult finish(const Stop& stop) {
    RunResult result{stop.end, stop.reason, summarise(simulation(), run_.writer, stop.reason, recorder_.wall_time())};
    // This comes before the run is finished, because finishing removes the checkpoints from which a dump is made.
    const std::size_t floes = run_.scene.scene.floes.size();
    const bool has_floes = control_.final_geojson || floes <= kMostFloesInFinal;
    if (!has_floes)
      result.summary.warnings.push_back(
          fmt::format("no {} was written, of {} floes at the start: --final-geojson writes it, polynya export "
                      "--geojson makes it of the last frame",
                      run_file::kFinalGeojson, floes));
    const bool is_failure = stop.end == RunEnd::kNumericalFailure || !result.summary.accounts_close();
    if (is_failure && !run_.writer.is_displaced()) result.dump = dump_failure(run_);
    if (const auto written = run_.writer.finish(result.summary, has_floes ? &simulation() : nullptr); !written) {
      result.end = RunEnd::kFolderFailure;
      result.reason = written.error();
    }
    return result;
  }

 private:
  Simulation& simulation() { return run_.simulation; }

  std::optional<Stop> advance_step() {
    simulation().step();
    recorder_.record_step();
    auto failure = control_.check ? failure_after_step(simulation()) : numerical_failure_of(simulation());
    if (failure) return Stop{RunEnd::kNumericalFailure, *std::move(failure)};
    recorder_.frame_if_due();
    if (auto stop = stop_on_request()) return stop;
    return work_between_steps();
  }

  std::optional<Stop> stop_on_request() {
    auto reason = control_.stop ? control_.stop() : std::nullopt;
    if (!reason) return {};
    if (auto failed = stop_where_failed(recorder_.checkpoint())) return failed;
    return Stop{RunEnd::kStopped, *reason};
  }

  /// Writes checkpoints, flushes files and reports progress, each when it is due.
  std::optional<Stop> work_between_steps() {
    const std::int64_t step = simulation().steps();
    const bool is_report_due = step % kStepsBetweenReports == 0;
    const bool is_due_by_time =
        control_.checkpoint_every > 0 && is_due(simulation().world().clock, control_.checkpoint_every);
    const bool is_due_by_wall = is_report_due && control_.checkpoint_every_wall > 0 &&
                                recorder_.checkpoint_age() >= control_.checkpoint_every_wall;
    if (is_due_by_time || is_due_by_wall) return stop_where_failed(recorder_.checkpoint());
    if (!is_report_due) return {};
    run_.writer.flush_if_due();
    if (auto stop = stop_where_failed(run_.writer.status())) return stop;
    if (control_.progress) control_.progress({simulation().time(), fractures_of(simulation().world().accounts.counts)});
    return {};
  }

  ActiveRun& run_;
  const RunControl& control_;
  RunRecorder recorder_;
  std::int64_t last_step_ = 0;
};

}  // namespace

RunResult run_to_end(ActiveRun& run, const RunControl& control) {
  RunLoop loop(run, control);
  return loop.finish(loop.advance().value_or(Stop{}));
}

}  // namespace polynya::io
