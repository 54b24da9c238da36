#include "app/run_driver.hpp"

#include <filesystem>
#include <new>
#include <optional>

#include "app/console.hpp"
#include "app/memory_check.hpp"
#include "app/options.hpp"
#include "app/run_result.hpp"
#include "app/stop_signal.hpp"
#include "io/run/run_loop.hpp"
#include "io/run/run_reader.hpp"
#include "views/map/final_map.hpp"

namespace polynya::app {
namespace {

using io::RunEnd;

std::optional<std::string> reason_to_stop() {
  const int signal = stop_signal();
  if (signal == 0) return {};
  return signal == 2 ? "SIGINT" : signal == 15 ? "SIGTERM" : fmt::format("signal {}", signal);
}

/// What stopped the run, and how to continue it.
void report_stop(const io::ActiveRun& run, const io::RunResult& result) {
  const std::string folder = run.writer.folder().string();
  print_err("polynya: stopped at {:.6g} s: {}\n", result.summary.sim_time, result.reason);
  if (run.writer.is_displaced())
    print_err(
        "polynya: the run is lost unless its folder is elsewhere now, with all its files; resume it there\n");
  else if (result.end == RunEnd::kNumericalFailure)
    print_err("polynya: {} holds the run up to there\n", folder);
  else if (result.end == RunEnd::kFolderFailure)
    print_err("polynya: once that is fixed, continue with: polynya resume {}\n", folder);
  else
    print_err("polynya: continue with: polynya resume {}\n", folder);
}

void report_dump(const std::string& folder, const io::Result<>& dump) {
  if (dump)
    print_err(
        "polynya: the state before the step that failed is in failure.bin: polynya resume {} "
        "--from-failure\n",
        folder);
  else
    print_err("polynya: the failure could not be dumped: {}\n", dump.error());
}

ExitCode report(io::ActiveRun& run, io::RunResult result, bool no_map) {
  { const simulation::Simulation freed = std::move(run.simulation); }  // makes room for the map
  const std::filesystem::path& folder = run.writer.folder();
  const DrawnMap map = no_map || result.end == RunEnd::kFolderFailure ? DrawnMap{} : draw_map(folder);
  if (map.end != RunEnd::kFinished) {
    result.end = map.end;
    result.reason = map.reason;
  }
  if (result.end != RunEnd::kFinished) report_stop(run, result);
  if (result.dump) report_dump(folder.string(), *result.dump);
  for (const std::string& warning : result.summary.warnings) print_err("note: {}\n", warning);
  if (result.end != RunEnd::kFolderFailure) print_result(result.summary, run.scene.scene, folder, map.name);
  return exit_code_of(result.end);
}

/// Of a run whose memory ran out: it is as if it had been killed.
ExitCode report_out_of_memory(const std::filesystem::path& folder) {
  print_err("polynya: {}\n", out_of_memory());
  print_err("polynya: {} is that of a run that was killed; {}\n", folder.string(), kToNeedLessMemory);
  print_err("polynya: with more memory, continue from its newest checkpoint with: polynya resume {}\n",
            folder.string());
  return kOutOfMemory;
}

}  // namespace

ExitCode exit_code_of(RunEnd end) {
  switch (end) {
    case RunEnd::kFinished:
      return kDone;
    case RunEnd::kStopped:
      return kStopped;
    case RunEnd::kNumericalFailure:
      return kNumericalFailure;
    case RunEnd::kFolderFailure:
      return kInputOutput;
  }
  return kDone;
}

DrawnMap draw_map(const std::filesystem::path& folder) {
  const auto run = io::read_run(folder);
  if (!run) print_err("note: no map is drawn: {}\n", run.error());
  if (!run) return {};
  if (auto drawn = views::draw_final_map(*run))
    return {*drawn};
  else
    return {"", RunEnd::kFolderFailure, drawn.error()};
}

void add_run_options(CommandLine& command, DriverOptions& options) {
  io::RunControl& control = options.control;
  command.option("--threads", control.threads, "N", "Threads to step on; results do not depend on it",
                 whole(1, 1024));
  command.option("--checkpoint-every", control.checkpoint_every, "S",
                 "Simulated time between checkpoints, beside those by the clock [s]", between(1e-5, 1e7));
  command.option("--checkpoint-every-wall", control.checkpoint_every_wall, "S",
                 "Time by the clock between checkpoints, 60 if not given; 0: none by the clock [s]",
                 between(0, 1e7));
  command.flag("--check", control.check,
               "Recompute every cross-index and sum after every step; stop if one differs");
  command.flag("--no-map", options.no_map, "Do not draw final.svg and final.png");
  command.flag("--final-geojson", control.final_geojson,
               fmt::format("Write final.geojson also of more than {} floes", io::kMostFloesInFinal));
  add_progress(command, options.progress);
}

ExitCode drive_run(io::ActiveRun run, const DriverOptions& options) {
  Progress progress(options.progress, run.scene.scene.time.until);
  io::RunControl control = options.control;
  control.progress = [&](const io::RunStatus& at) { progress.show(at.time, at.fractures); };
  control.stop = reason_to_stop;
  const std::filesystem::path folder = run.writer.folder();
  try {
    const io::RunResult result = run_to_end(run, control);
    progress.finish(result.summary.sim_time, io::fractures_of(result.summary.counts));
    return report(run, result, options.no_map);
  } catch (const std::bad_alloc&) {
    return report_out_of_memory(folder);
  }
}

}  // namespace polynya::app
