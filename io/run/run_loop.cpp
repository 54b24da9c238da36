#include "io/run/run_loop.hpp"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

#include "io/run/failure_dump.hpp"
#include "simulation/world/world.hpp"

namespace polynya::io {
namespace {

using simulation::Simulation;
using Clock = std::chrono::steady_clock;

constexpr std::int64_t kStepsBetweenReports = 16;  ///< looking at the clock costs as much as a small step

struct Stop {
  RunEnd end = RunEnd::kFinished;
  std::string reason;
};

double seconds_since(Clock::time_point then) {
  return std::chrono::duration<double>(Clock::now() - then).count();
}

/// Steps in a time [s], at least 1.
std::int64_t steps_in(double duration, double step) {
  return std::max<std::int64_t>(1, std::llround(duration / step));
}

class RunLoop {
 public:
  RunLoop(ActiveRun& run, const RunControl& control) : run_(run), control_(control) {
    const simulation::StepSettings& time = simulation().scene().time;
    last_step_ = static_cast<std::int64_t>(std::ceil(time.until / time.step - 1e-9));
    steps_per_frame_ = steps_in(simulation().scene().record.frames_interval, time.step);
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
  Result<> checkpoint();

  Simulation& simulation() { return run_.simulation; }
  RunWriter& writer() { return run_.writer; }
  double wall_time() const { return run_.wall_time + seconds_since(start_); }

  ActiveRun& run_;
  const RunControl& control_;
  std::int64_t last_step_ = 0;
  std::int64_t steps_per_frame_ = 1;
  std::int64_t steps_per_checkpoint_ = 0;  ///< 0: by the clock alone
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_checkpoint_ = start_;
};

Stop RunLoop::advance() {
  simulation().set_threads(control_.threads);
  return advance_to_end().value_or(Stop{});
}

std::optional<Stop> RunLoop::advance_to_end() {
  if (simulation().steps() == 0) {
    writer().record(simulation().journal());
    writer().frame(simulation());
  }
  while (simulation().steps() < last_step_)
    if (auto stop = advance_step()) return stop;
  return {};
}

std::optional<Stop> RunLoop::advance_step() {
  simulation().step();
  writer().record(simulation().journal());
  if (auto failure = failure_of_step()) return Stop{RunEnd::kNumericalFailure, *failure};
  const std::int64_t step = simulation().steps();
  if (step % steps_per_frame_ == 0 || step == last_step_) writer().frame(simulation());
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
  if (const auto written = checkpoint(); !written) return Stop{RunEnd::kFolderFailure, written.error()};
  return Stop{RunEnd::kStopped, *reason};
}

/// Checkpoints, flushing and progress, each where it is due.
std::optional<Stop> RunLoop::work_between_steps() {
  const std::int64_t step = simulation().steps();
  const bool is_report_due = step % kStepsBetweenReports == 0;
  const bool is_checkpoint_due = (steps_per_checkpoint_ > 0 && step % steps_per_checkpoint_ == 0) ||
                                 (is_report_due && control_.checkpoint_every_wall > 0 &&
                                  seconds_since(last_checkpoint_) >= control_.checkpoint_every_wall);
  if (!is_checkpoint_due && !is_report_due) return {};
  if (!is_checkpoint_due) writer().flush_if_due();
  if (const auto written = is_checkpoint_due ? checkpoint() : writer().status(); !written)
    return Stop{RunEnd::kFolderFailure, written.error()};
  if (!is_checkpoint_due && control_.progress)
    control_.progress({simulation().time(), fractures_of(simulation().world().accounts.counts)});
  return {};
}

Result<> RunLoop::checkpoint() {
  auto progress = writer().sync();
  if (!progress) return fail(progress.error());
  auto written =
      write_checkpoint(writer().folder(), checkpoint_of(simulation(), run_.scene, std::move(*progress), wall_time()));
  last_checkpoint_ = Clock::now();
  return written;
}

RunResult RunLoop::finish(const Stop& stop) {
  RunResult result{stop.end, stop.reason, summarise(simulation(), writer(), stop.reason, wall_time())};
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
