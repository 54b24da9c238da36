#include "io/run/run_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "io/run/active_run.hpp"
#include "simulation/world/world.hpp"

namespace polynya::io {
namespace {

using simulation::Simulation;

constexpr std::int64_t kStepsBetweenReports = 16;  ///< looking at the clock costs as much as a small step

struct Stop {
  RunEnd end = RunEnd::kFinished;
  std::string reason;
};

double seconds_since(std::chrono::steady_clock::time_point then) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - then).count();
}

/// Steps in a time [s], at least 1.
std::int64_t steps_in(double duration, double step) {
  return std::max<std::int64_t>(1, std::llround(duration / step));
}

}  // namespace

RunRecorder::RunRecorder(Simulation& simulation, RunWriter& writer, const LoadedScene& scene, double wall_time)
    : simulation_(&simulation),
      writer_(&writer),
      scene_(&scene),
      wall_time_before_(wall_time),
      steps_per_frame_(steps_in(scene.scene.record.frames_interval, scene.scene.time.step)),
      longest_step_(longest_block(simulation.world().setup)) {}

void RunRecorder::begin(simulation::Journal& journal) {
  writer_->record(journal);
  writer_->frame(*simulation_);
}

void RunRecorder::record_step() {
  writer_->record(simulation_->journal());
}

void RunRecorder::frame_if_due() {
  if (is_frame_due()) writer_->frame(*simulation_);
}

Result<> RunRecorder::checkpoint(double wall_time) {
  auto progress = writer_->sync();
  if (!progress) return fail(progress.error());
  auto written =
      write_checkpoint(writer_->folder(), checkpoint_of(*simulation_, *scene_, std::move(*progress), wall_time));
  last_checkpoint_ = Clock::now();
  return written;
}

Result<> RunRecorder::before_end(std::int64_t ticks_left) {
  if (ticks_left >= longest_step_ || has_end_checkpoint()) return {};
  end_checkpoint_at_ = simulation_->steps();
  return checkpoint(0);  // so that folders of one run are the same bytes
}

bool RunRecorder::has_end_checkpoint() const {
  return end_checkpoint_at_ && simulation_->steps() - *end_checkpoint_at_ < longest_step_;
}

Result<> RunRecorder::end() {
  auto written = has_end_checkpoint() ? Result<>{} : checkpoint(0);
  if (written && !is_frame_due()) writer_->frame(*simulation_);
  return written;
}

double RunRecorder::wall_time() const {
  return wall_time_before_ + seconds_since(start_);
}

double RunRecorder::checkpoint_age() const {
  return seconds_since(last_checkpoint_);
}

namespace {

class RunLoop {
 public:
  RunLoop(ActiveRun& run, const RunControl& control)
      : run_(run), control_(control), recorder_(run.simulation, run.writer, run.scene, run.wall_time) {
    const simulation::StepSettings& time = simulation().scene().time;
    last_step_ = last_step_of(time);
    if (control.checkpoint_every > 0) steps_per_checkpoint_ = steps_in(control.checkpoint_every, time.step);
  }

  Stop advance();
  RunResult finish(const Stop& stop);

 private:
  std::optional<Stop> advance_to_end();
  std::optional<Stop> advance_step();
  std::optional<Stop> stop_on_request();
  std::optional<Stop> work_between_steps();
  std::optional<std::string> failure_of_step() const;

  Simulation& simulation() { return run_.simulation; }
  RunWriter& writer() { return run_.writer; }

  ActiveRun& run_;
  const RunControl& control_;
  RunRecorder recorder_;
  std::int64_t last_step_ = 0;
  std::int64_t before_ = 0;                ///< ticks before the last step, which may take several
  std::int64_t steps_per_checkpoint_ = 0;  ///< 0: by the clock alone
};

Stop RunLoop::advance() {
  simulation().set_threads(control_.threads);
  return advance_to_end().value_or(Stop{});
}

std::optional<Stop> RunLoop::advance_to_end() {
  if (!writer().has_begun()) recorder_.begin(simulation().journal());
  while (simulation().steps() < last_step_)
    if (auto stop = advance_step()) return stop;
  if (const auto written = recorder_.end(); !written) return Stop{RunEnd::kFolderFailure, written.error()};
  return {};
}

std::optional<Stop> RunLoop::advance_step() {
  before_ = simulation().steps();
  if (const auto written = recorder_.before_end(last_step_ - before_); !written)
    return Stop{RunEnd::kFolderFailure, written.error()};
  simulation().step(last_step_ - before_);
  recorder_.record_step();
  if (auto failure = failure_of_step()) return Stop{RunEnd::kNumericalFailure, *failure};
  recorder_.frame_if_due();
  if (auto stop = stop_on_request()) return stop;
  return work_between_steps();
}

std::optional<std::string> RunLoop::failure_of_step() const {
  if (control_.check) return failure_after_step(run_.simulation);
  if (auto failure = run_.simulation.numerical_failure()) return "numerical failure: " + *failure;
  return {};
}

std::optional<Stop> RunLoop::stop_on_request() {
  auto reason = control_.stop ? control_.stop() : std::nullopt;
  if (!reason) return {};
  // Within the last steps, which this end cuts short, the one before them stands: a longer run goes on from there.
  const auto written = recorder_.has_end_checkpoint() ? Result<>{} : recorder_.checkpoint();
  if (!written) return Stop{RunEnd::kFolderFailure, written.error()};
  return Stop{RunEnd::kStopped, *reason};
}

/// Checkpoints, flushing and progress, each where it is due.
std::optional<Stop> RunLoop::work_between_steps() {
  const std::int64_t step = simulation().steps();
  const auto is_due = [&](std::int64_t every) { return step / every > before_ / every; };
  const bool is_report_due = is_due(kStepsBetweenReports);
  const bool is_checkpoint_due =
      !recorder_.has_end_checkpoint() && ((steps_per_checkpoint_ > 0 && is_due(steps_per_checkpoint_)) ||
                                          (is_report_due && control_.checkpoint_every_wall > 0 &&
                                           recorder_.checkpoint_age() >= control_.checkpoint_every_wall));
  if (!is_checkpoint_due && !is_report_due) return {};
  if (!is_checkpoint_due) writer().flush_if_due();
  if (const auto written = is_checkpoint_due ? recorder_.checkpoint() : writer().status(); !written)
    return Stop{RunEnd::kFolderFailure, written.error()};
  if (!is_checkpoint_due && control_.progress)
    control_.progress({simulation().time(), fractures_of(simulation().world().accounts.counts)});
  return {};
}

RunResult RunLoop::finish(const Stop& stop) {
  RunResult result{stop.end, stop.reason, summarise(simulation(), writer(), stop.reason, recorder_.wall_time())};
  // Before the run is finished: that takes away the checkpoints from which the failure is sought.
  const std::size_t floes = run_.scene.scene.floes.size();
  const bool has_floes = control_.final_geojson || floes <= kMostFloesInFinal;
  if (!has_floes)
    result.summary.warnings.push_back(
        fmt::format("no {} was written, of {} floes at the start: --final-geojson writes it, polynya export "
                    "--geojson makes it of the last frame",
                    run_file::kFinalGeojson, floes));
  const bool is_failure = stop.end == RunEnd::kNumericalFailure || !result.summary.audit.is_closed();
  if (is_failure && !writer().is_displaced()) result.dump = dump_failure(run_);
  if (const auto written = writer().finish(result.summary, has_floes ? &simulation() : nullptr); !written) {
    result.end = RunEnd::kFolderFailure;
    result.reason = written.error();
  }
  return result;
}

}  // namespace

RunResult run_to_end(ActiveRun& run, const RunControl& control) {
  RunLoop loop(run, control);
  return loop.finish(loop.advance());
}

}  // namespace polynya::io
