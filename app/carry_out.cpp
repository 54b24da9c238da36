#include "app/carry_out.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <new>
#include <optional>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/failure_dump.hpp"
#include "app/last_whole_step.hpp"
#include "app/memory_check.hpp"
#include "app/memory_reserve.hpp"
#include "app/run_result.hpp"
#include "app/stop_signal.hpp"
#include "io/run/run_folder.hpp"
#include "simulation/world.hpp"
#include "views/map/final_map.hpp"

namespace polynya::app {
namespace {

using simulation::Simulation;
using Clock = std::chrono::steady_clock;

std::string signal_name(int signal) {
  return signal == 2 ? "SIGINT" : signal == 15 ? "SIGTERM" : fmt::format("signal {}", signal);
}

/// How a run ended, or what stopped it.
struct Stop {
  ExitCode code = kDone;
  std::string reason;
  bool is_out_of_memory = false;
};

Stop no_memory() {
  return {kOutOfMemory, "memory", true};
}

/// Carries a run from where it is to its end, writing as it goes.
class Carrier {
 public:
  Carrier(ActiveRun& run, const CarryOptions& options, Progress& progress)
      : run_(run),
        options_(options),
        progress_(progress),
        last_whole_step_(run.simulation),
        last_checkpoint_(Clock::now()) {
    const simulation::StepSettings& time = simulation().scene().time;
    const simulation::RecordSettings& record = simulation().scene().record;
    last_step_ = static_cast<std::int64_t>(std::ceil(time.until / time.step - 1e-9));
    steps_per_frame_ = std::max<std::int64_t>(1, std::llround(record.frames_interval / time.step));
    if (options.checkpoint_every > 0)
      steps_per_checkpoint_ = std::max<std::int64_t>(1, std::llround(options.checkpoint_every / time.step));
  }

  Stop carry() {
    try {
      return advance();
    } catch (const std::bad_alloc&) {
      return no_memory();
    } catch (const std::system_error&) {
      throw;
    } catch (const std::runtime_error& no_thread) {  // TBB's, which starts threads when it needs them
      if (options_.threads == 1) throw;
      return {kOutOfMemory, no_thread.what(), true};
    }
  }

  /// Between two steps: there may be memory for a checkpoint still.
  Stop stop_without_memory() {
    try {
      if (Stop stop = checkpoint(); stop.code != kDone) return stop;
    } catch (const std::bad_alloc&) {
    }  // an older one, or the start, has to do
    return no_memory();
  }

  const LastWholeStep& last_whole_step() const { return last_whole_step_; }

 private:
  Stop advance() {
    std::int64_t step = simulation().steps();
    if (step == 0) {
      writer().record(simulation().journal());
      writer().frame(simulation());
    }
    while (step < last_step_) {
      simulation().step();
      ++step;
      take_down_step();
      if (auto failure = failure_of_step()) return {kNumericalFailure, *failure};
      if (step % steps_per_frame_ == 0 || step == last_step_) writer().frame(simulation());
      if (is_memory_reserve_used()) return stop_without_memory();
      if (const int signal = stop_signal()) return stop_on(signal);
      if (Stop stop = look_around(step); stop.code != kDone) return stop;
    }
    return {};
  }

  Simulation& simulation() { return run_.simulation; }
  io::RunWriter& writer() { return run_.writer; }

  std::optional<std::string> failure_of_step() {
    if (options_.check) return failure_after_step(simulation());
    if (auto failure = simulation().numerical_failure()) return "numerical failure: " + *failure;
    return {};
  }

  void take_down_step() {
    simulation::Journal& journal = simulation().journal();
    const auto more_floes = std::ssize(journal.births) - std::ssize(journal.deaths);
    writer().record(journal);
    last_whole_step_.take(simulation(), more_floes);
  }

  Stop stop_on(int signal) {
    if (Stop stop = checkpoint(); stop.code != kDone) return stop;
    return {kStopped, signal_name(signal)};
  }

  /// What is done now and then.
  Stop look_around(std::int64_t step) {
    if (steps_per_checkpoint_ > 0 && step % steps_per_checkpoint_ == 0) return checkpoint();
    if (step % 16 != 0) return {};
    if (options_.checkpoint_every_wall > 0 &&
        seconds_since(last_checkpoint_) >= options_.checkpoint_every_wall)
      return checkpoint();
    writer().flush_if_due();
    if (std::string failure = writer().failure(); !failure.empty()) return {kInputOutput, failure};
    const simulation::Counts& counts = simulation().world().accounts.counts;
    progress_.show(simulation().time(), counts.bends + counts.splits + counts.rejected_cuts);
    return {};
  }

  static double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }

  Stop checkpoint() {
    const io::RunProgress where = writer().sync();
    std::string failure = writer().failure();
    if (failure.empty())
      failure = io::write_checkpoint(
          writer().folder(),
          checkpoint_of(simulation(), run_.scene, where, run_.wall_time + progress_.wall_time()));
    last_checkpoint_ = Clock::now();
    if (!failure.empty()) return {kInputOutput, failure};
    return {};
  }

  ActiveRun& run_;
  const CarryOptions& options_;
  Progress& progress_;
  LastWholeStep last_whole_step_;
  std::int64_t last_step_ = 0;
  std::int64_t steps_per_frame_ = 1;
  std::int64_t steps_per_checkpoint_ = 0;
  Clock::time_point last_checkpoint_;
};

/// What dump_failure() said.
void report_dump(const std::string& folder, const std::string& wrong) {
  if (wrong.empty()) {
    print_err(
        "polynya: the state before the step that failed is in failure.bin: polynya resume {} "
        "--from-failure\n",
        folder);
  } else {
    print_err("polynya: the failure could not be dumped: {}\n", wrong);
  }
}

/// What the reader of stderr is to do about it.
void report_stop(const ActiveRun& run, const Stop& stop, double sim_time) {
  const std::string folder = run.writer.folder().string();
  print_err("polynya: stopped at {:.6g} s: {}\n", sim_time, stop.reason);
  if (run.writer.is_displaced()) {
    print_err(
        "polynya: the run is lost unless its folder is elsewhere now, with all its files; resume it there\n");
  } else if (stop.code == kNumericalFailure && !stop.is_out_of_memory) {
    print_err("polynya: {} holds the run up to there\n", folder);
  } else if (stop.code == kInputOutput) {
    print_err("polynya: once that is put right, go on with: polynya resume {}\n", folder);
  } else {
    print_err("polynya: go on with: polynya resume {}\n", folder);
  }
}

/// Draws the run's map and returns its name; empty where the folder cannot be read back, or the map not
/// written, which is a failure of the run's output, or does not fit into memory.
std::string draw(const std::filesystem::path& folder, Stop& stop) {
  try {
    const auto run = io::read_run(folder);
    if (!run) print_err("note: no map is drawn: {}\n", run.error());
    if (!run) return "";
    auto drawn = views::draw_final_map(*run);
    if (drawn) return *drawn;
    stop = {kInputOutput, drawn.error()};
  } catch (const std::bad_alloc&) {
    stop = {kOutOfMemory, "the final map: " + out_of_memory(), true};
  }
  return "";
}

/// What there is to report of a run whose folder is finished.
struct Ending {
  Stop stop;
  io::RunSummary summary;
  std::optional<std::string> dumped;
};

Ending finish(ActiveRun& run, Stop stop, Progress& progress) {
  io::RunSummary summary =
      summarise(run.simulation, run.writer, stop.reason, run.wall_time + progress.wall_time());
  progress.finish(summary.sim_time,
                  summary.counts.bends + summary.counts.splits + summary.counts.rejected_cuts);
  // Before the run is finished: that takes away the checkpoints from which the failure is sought.
  std::optional<std::string> dumped;
  const bool is_to_be_dumped = stop.code == kNumericalFailure || !summary.audit.is_closed();
  if (is_to_be_dumped && !run.writer.is_displaced()) dumped = dump_failure(run);
  if (const std::string failure = run.writer.finish(summary, run.simulation); !failure.empty())
    stop = {kInputOutput, failure};
  return {stop, std::move(summary), std::move(dumped)};
}

int report(ActiveRun& run, const Ending& ending) {
  Stop stop = ending.stop;
  { const Simulation freed = std::move(run.simulation); }  // makes room for the map
  const std::string picture = stop.code == kInputOutput ? "" : draw(run.writer.folder(), stop);
  if (stop.code != kDone) report_stop(run, stop, ending.summary.sim_time);
  if (ending.dumped) report_dump(run.writer.folder().string(), *ending.dumped);
  for (const std::string& warning : ending.summary.warnings) print_err("note: {}\n", warning);
  if (stop.code != kInputOutput) print_result(ending.summary, run.scene.scene, run.writer.folder(), picture);
  return stop.code;
}

/// Ends a run whose world is not to be relied on, since memory ran out in it; what it takes is freed first.
int end_without_memory(ActiveRun& run, const Stop& stop, const LastWholeStep& last, Progress& progress) {
  { const Simulation freed = std::move(run.simulation); }
  release_memory_reserve();
  io::RunSummary summary;
  last.fill(summary);
  summary.stopped_by = stop.reason;
  summary.wall_time = run.wall_time + progress.wall_time();
  summary.peaks = run.writer.peaks();
  summary.warnings.emplace_back(
      "memory ran out: floe area, kinetic energy and momentum are what the accounts leave, not measured");
  progress.finish(summary.sim_time,
                  summary.counts.bends + summary.counts.splits + summary.counts.rejected_cuts);
  const std::string failure = run.writer.cut_off(summary);
  if (!failure.empty()) {
    report_stop(run, {kInputOutput, failure}, summary.sim_time);
    return kInputOutput;
  }
  const std::string folder = run.writer.folder().string();
  const auto checkpoints = io::checkpoints_in(folder);
  print_err("polynya: stopped at {:.6g} s: {}\n", summary.sim_time,
            stop.reason == no_memory().reason ? out_of_memory() : stop.reason);
  print_err("polynya: {} holds the run up to there, without the final map; {}\n", folder, kToNeedLessMemory);
  print_err("polynya: with more memory, go on {} with: polynya resume {}\n",
            checkpoints.empty() ? "from the start" : "from " + checkpoints.front().filename().string(),
            folder);
  return kOutOfMemory;
}

}  // namespace

int carry_out(ActiveRun run, const CarryOptions& options) {
  keep_memory_reserve();
  run.simulation.set_threads(options.threads);
  Progress progress(options.progress, run.scene.scene.time.until);
  Carrier carrier(run, options, progress);
  Stop stop = carrier.carry();
  std::optional<Ending> ending;
  try {
    if (!stop.is_out_of_memory) ending = finish(run, stop, progress);
  } catch (const std::bad_alloc&) {  // in final.geojson
    if (stop.code == kDone) carrier.stop_without_memory();
    stop = no_memory();
  }
  return ending ? report(run, *ending) : end_without_memory(run, stop, carrier.last_whole_step(), progress);
}

}  // namespace polynya::app
