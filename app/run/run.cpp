#include <algorithm>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "analysis/run_listing.hpp"
#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/run/load_scene.hpp"
#include "io/run/checksums.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_loop.hpp"
#include "io/run/run_reader.hpp"
#include "io/run/run_writer.hpp"
#include "simulation/simulation.hpp"
#include "views/map/final_map.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;
using io::RunEnd;
using simulation::Simulation;

// ---- carrying out a run

/// Options of a run, whether it is started or resumed.
struct DriverOptions {
  io::RunControl control;
  ProgressKind progress = ProgressKind::kAuto;
  bool no_map = false;  ///< leave out the picture of the last frame
};

/// Draws the map of the last frame into the run's folder. Returns the name of the picture; empty, with a note on
/// stderr, if the folder is too large to be read back.
io::Result<std::string> draw_map(const fs::path& folder) {
  const auto run = io::read_run(folder);
  if (!run) {
    print_err("note: no map is drawn: {}\n", run.error());
    return "";
  }
  auto picture = views::draw_final_map(*run);
  std::vector<std::string_view> drawn;
  for (const std::string_view name : {io::run_file::kFinalSvg, io::run_file::kFinalPng})
    if (fs::exists(folder / name)) drawn.push_back(name);
  const auto added = picture ? io::add_checksums(folder, drawn) : io::Result<>();
  return added ? picture : io::fail(added.error());
}

std::optional<std::string> reason_to_stop() {
  const int signal = stop_signal();
  if (signal == 0) return {};
  return signal == 2 ? "SIGINT" : signal == 15 ? "SIGTERM" : fmt::format("signal {}", signal);
}

/// Reports why the run stopped, and how to continue it.
void report_stop(const io::ActiveRun& run, const io::RunResult& result) {
  const std::string folder = run.writer.folder().string();
  print_err("polynya: stopped at {:.6g} s: {}\n", result.summary.sim_time, result.reason);
  if (run.writer.is_displaced())
    print_err("polynya: the run is lost unless its folder is elsewhere now, with all its files; resume it there\n");
  else if (result.end == RunEnd::kNumericalFailure)
    print_err("polynya: {} holds the run up to there\n", folder);
  else if (result.end == RunEnd::kFolderFailure)
    print_err("polynya: once that is fixed, continue with: polynya resume {}\n", folder);
  else
    print_err("polynya: continue with: polynya resume {}\n", folder);
}

void report_dump(const std::string& folder, const io::Result<>& dump) {
  if (dump)
    print_err("polynya: the state before the step that failed is in failure.bin: polynya resume {} --from-failure\n",
              folder);
  else
    print_err("polynya: the failure could not be dumped: {}\n", dump.error());
}

ExitCode report(io::ActiveRun& run, io::RunResult result, bool no_map) {
  { const Simulation freed = std::move(run.simulation); }  // frees memory for the map
  const fs::path& folder = run.writer.folder();
  const io::Result<std::string> picture = no_map || result.end == RunEnd::kFolderFailure ? "" : draw_map(folder);
  if (!picture) {
    result.end = RunEnd::kFolderFailure;
    result.reason = picture.error();
  }
  if (result.end != RunEnd::kFinished) report_stop(run, result);
  if (result.dump) report_dump(folder.string(), *result.dump);
  for (const std::string& warning : result.summary.warnings) print_err("note: {}\n", warning);
  if (result.end != RunEnd::kFolderFailure) {
    print_out("{}run folder  {}\n", analysis::result_text(result.summary, run.scene.scene), folder.string());
    if (!picture->empty()) print_out("picture     {}\n", (folder / *picture).string());
  }
  return result.end == RunEnd::kFinished           ? kDone
         : result.end == RunEnd::kStopped          ? kStopped
         : result.end == RunEnd::kNumericalFailure ? kNumericalFailure
                                                   : kInputOutput;
}

void add_run_options(CommandLine& command, DriverOptions& options) {
  io::RunControl& control = options.control;
  command.option("--threads", &control.threads, "N", "Number of threads; results do not depend on it", whole(1, 1024));
  command.option("--checkpoint-every", &control.checkpoint_every, "S",
                 "Simulated time between checkpoints, in addition to those by wall time [s]", between(1e-5, 1e7));
  command.option("--checkpoint-every-wall", &control.checkpoint_every_wall, "S",
                 "Wall time between checkpoints [s]; 60 if not given, 0: none by wall time", between(0, 1e7));
  command.flag("--check", control.check, "Check the whole state after every step, and stop at the first fault; slow");
  command.flag("--no-map", options.no_map, "Do not draw final.svg and final.png");
  command.flag("--final-geojson", control.final_geojson,
               fmt::format("Write final.geojson even if there are more than {} floes", io::kMostFloesInFinal));
  add_progress(command, options.progress);
}

ProgressReport progress_of(const io::RunStatus& at, double until, double wall_time) {
  const double sim_time = at.time, wall = std::max(wall_time, 1e-9);
  const double rate = sim_time / wall;
  const double part = until > 0 ? sim_time / until : 1;
  const double left = rate > 0 ? std::max(0.0, until - sim_time) / rate : 0;
  return {part,
          fmt::format("{:3.0f} %  {:.1f} of {:g} s  {:.3g} x real time  {} left  {}", 100 * part, sim_time, until, rate,
                      clock_time(left), counted(at.fractures, "fracture")),
          fmt::format(R"({{"sim_time_s":{:.6g},"until_s":{:.6g},"wall_time_s":{:.3f},"real_time_factor":{:.4g},)"
                      R"("time_left_s":{:.1f},"fractures":{}}})",
                      sim_time, until, wall, rate, left, at.fractures)};
}

/// Carries a run to its end, or until something stops it (io/run/run_loop.hpp), and prints the result.
ExitCode drive_run(io::ActiveRun run, const DriverOptions& options) {
  ProgressOutput output(options.progress);
  const double until = run.scene.scene.time.until;
  io::RunControl control = options.control;
  control.progress = [&](const io::RunStatus& at) {
    if (output.is_due()) output.show(progress_of(at, until, output.wall_time()));
  };
  control.stop = reason_to_stop;
  const io::RunResult result = run_to_end(run, control);
  const io::RunStatus at{result.summary.sim_time, io::fractures_of(result.summary.counts)};
  output.finish(progress_of(at, until, output.wall_time()));
  return report(run, result, options.no_map);
}

/// Calls a function that starts or continues the run of a folder. If memory runs out, reports this and what to do; the
/// folder is then like that of a killed run.
template <class Work>
int within_memory(const fs::path& folder, Work make_or_continue) {
  try {
    return make_or_continue();
  } catch (const std::bad_alloc&) {
    print_err("polynya: {}\n", out_of_memory());
    print_err("polynya: {} is now like the folder of a killed run; {}\n", folder.string(), kToNeedLessMemory);
    print_err("polynya: with more memory, continue from its newest checkpoint with: polynya resume {}\n",
              folder.string());
    return kOutOfMemory;
  }
}

// ---- polynya run

struct RunOptions {
  std::string scene;
  std::string out;              ///< empty: runs/<scene name>
  std::optional<double> until;  ///< [s]
  std::optional<std::uint64_t> seed;
  std::vector<std::string> set;
  std::optional<double> panel;  ///< length of panels [m]
  bool overwrite = false;
  DriverOptions driver;
};

/// A run before its first step. Whether it fits into memory is checked before anything is written.
struct Start {
  io::LoadedScene scene;
  Simulation simulation;
};

Outcome<Start> start_of(const RunOptions& options) {
  try {
    auto loaded = load_scene(options.scene,
                             {.until = options.until,
                              .seed = options.seed,
                              .assignments = assignments_of(options.set),
                              .panel_length = options.panel},
                             options.driver.progress);
    if (!loaded) return tl::unexpected(loaded.error());
    print_lines(loaded->hints);
    print_fields(*loaded);
    if (!may_fit(loaded->scene, options.scene, io::memory_available())) return tl::unexpected(kOutOfMemory);
    print_folder_size(loaded->scene, options.driver.control.final_geojson);
    Simulation simulation(loaded->scene);
    return Start{*std::move(loaded), std::move(simulation)};
  } catch (const std::bad_alloc&) {
    return failure(kOutOfMemory,
                   fmt::format("{}: {}; nothing was written; {}", options.scene, out_of_memory(), kToNeedLessMemory));
  }
}

int run(const RunOptions& options) {
  auto start = start_of(options);
  if (!start) return start.error();
  const fs::path folder = options.out.empty() ? fs::path("runs") / start->scene.scene.name : fs::path(options.out);
  watch_signals();
  return within_memory(folder, [&]() -> int {
    auto writer = io::RunWriter::create(folder, options.overwrite, start->scene);
    if (!writer) return fail(kInputOutput, writer.error());
    return drive_run({start->scene, std::move(start->simulation), std::move(*writer)}, options.driver);
  });
}

// ---- polynya resume

struct ResumeOptions {
  std::string folder;
  std::string checkpoint;       ///< empty: the newest checkpoint
  std::optional<double> until;  ///< replaces the scene's end [s]
  bool from_failure = false;    ///< only repeat the step for which a failure was dumped
  DriverOptions driver;
};

/// Prints the other checkpoints after one was refused.
void offer_others(const fs::path& folder, const fs::path& refused) {
  for (const fs::path& other : io::checkpoints_in(folder)) {
    if (other.filename() == refused.filename()) continue;
    print_err("polynya: there is another: polynya resume {} --checkpoint {}\n", folder.string(), other.string());
  }
  print_err("polynya: or from the start: polynya run {} --out {} --overwrite\n",
            (folder / io::run_file::kScene).string(), folder.string());
}

/// Repeats the step after a dump and reports whether it fails in the same way.
int repeat_failure(const io::LoadedScene& scene, const fs::path& folder) {
  const fs::path path = folder / io::run_file::kFailure;
  const auto dump = io::read_checkpoint_file(path, scene.course_hash);
  if (!dump) return fail(kInputOutput, dump.error());
  auto simulation = io::simulation_at(scene, *dump);
  if (!simulation) return fail(kInputOutput, fmt::format("{}: {}", path.string(), simulation.error()));
  print_out("state       step {}, t = {:.9g} s, hash {:016x}\n", simulation->steps(), simulation->time(),
            simulation->state_hash());
  print_out("then        {}\n", dump->failure);
  simulation->step();
  const std::string now = io::failure_after_step(*simulation).value_or("nothing went wrong");
  print_out("now         {}\n", now);
  print_out("{}\n", now == dump->failure ? "reproduced" : "not reproduced");
  return now == dump->failure ? kNumericalFailure : kDone;
}

/// Returns a message on why there is no run in a folder that could be resumed.
std::string no_run_in(const fs::path& folder) {
  const std::string name = folder.string();
  if (io::is_marked_run_folder(folder))
    return fmt::format(
        "{0}: no run to resume: polynya was killed before it had written {1}; start the run again with polynya run "
        "SCENE --out {0} --overwrite",
        name, io::run_file::kScene);
  return fmt::format("{}: no run to resume: it has no {}; give a folder that polynya run wrote", name,
                     io::run_file::kScene);
}

/// Refuses to continue a finished run with damaged files.
int refuse_damaged(const fs::path& folder, const io::FilesCheck& files) {
  for (const std::string& file : files.damaged) fail(kInputOutput, file);
  print_err("polynya: bring the files back from a copy, or run it again: polynya run {} --out {} --overwrite\n",
            (folder / io::run_file::kScene).string(), folder.string());
  return kInputOutput;
}

/// Reports that a run has finished, and completes its folder: if the command was killed after the end of the run, there
/// may be too many checkpoints, missing pictures, or checksums of pictures that were not written to their end.
int report_finished(const fs::path& folder, double end, bool no_map) {
  if (const auto files = io::check_files(folder); !files.damaged.empty()) return refuse_damaged(folder, files);
  print_err("polynya: {}: the run has finished at {:.6g} s; to extend it, give --until with a later time\n",
            folder.string(), end);
  const bool is_drawn = fs::exists(folder / io::run_file::kFinalSvg) && fs::exists(folder / io::run_file::kFinalPng);
  const fs::path remains = io::temporary_name(folder / io::run_file::kChecksums);
  if (is_drawn && io::checkpoints_in(folder).size() <= 1 && !fs::exists(fs::symlink_status(remains))) return kDone;
  const auto lock = io::RunLock::take(folder);
  if (!lock) return kDone;                               // another polynya is completing the folder
  static_cast<void>(io::remove_checkpoints(folder, 1));  // if this fails, a later command tries again
  static_cast<void>(io::remove_file(remains));
  if (is_drawn || no_map) return kDone;
  const auto map = draw_map(folder);
  return map ? kDone : fail(kInputOutput, map.error());
}

int resume_from_checkpoint(const io::LoadedScene& scene, io::RunLock lock, const ResumeOptions& options) {
  const fs::path folder = lock.folder();
  const std::vector<fs::path> checkpoints = io::checkpoints_in(folder);
  if (checkpoints.empty() && options.checkpoint.empty()) {
    print_err("polynya: {}: there is no checkpoint; starting from the beginning\n", folder.string());
    if (const auto ready = io::set_end(folder, scene); !ready) return fail(kInputOutput, ready.error());
    auto writer = io::RunWriter::begin(std::move(lock), scene);
    if (!writer) return fail(kInputOutput, writer.error());
    return drive_run({scene, Simulation(scene.scene), std::move(*writer)}, options.driver);
  }
  const fs::path chosen = options.checkpoint.empty() ? checkpoints.front() : fs::path(options.checkpoint);
  auto run = io::resume_run(std::move(lock), scene, chosen);
  if (!run) {
    fail(kInputOutput, run.error());
    offer_others(folder, chosen);
    return kInputOutput;
  }
  print_err("polynya: from {} at {:.6g} s\n", chosen.filename().string(), run->simulation.time());
  return drive_run(std::move(*run), options.driver);
}

int resume(const ResumeOptions& options) {
  const fs::path folder = options.folder;
  const fs::path scene_file = folder / io::run_file::kScene;
  if (!fs::is_regular_file(scene_file)) return fail(kInputOutput, no_run_in(folder));
  if (options.from_failure) {
    const auto scene = load_scene(scene_file.string());
    return scene ? repeat_failure(*scene, folder) : scene.error();
  }
  const auto finished = [&]() -> std::optional<double> {
    if (io::lacks_checksums(folder)) return std::nullopt;  // its end is done again
    const auto end = io::finished_run(folder);
    return end && options.until.value_or(0) <= end->time ? std::optional(end->time) : std::nullopt;
  };
  if (const auto end = finished()) return report_finished(folder, *end, options.driver.no_map);
  auto lock = io::RunLock::take(folder);
  if (!lock) return fail(kInputOutput, lock.error());
  if (const auto end = finished())
    return report_finished(folder, *end, options.driver.no_map);  // another polynya has finished it in the meantime
  if (const auto files = io::check_files(folder); !files.damaged.empty()) return refuse_damaged(folder, files);
  watch_signals();
  const auto scene =
      load_scene(scene_file.string(), {.until = options.until, .seed = {}, .assignments = {}}, options.driver.progress);
  if (!scene) return scene.error();
  return within_memory(folder, [&] { return resume_from_checkpoint(*scene, std::move(*lock), options); });
}

}  // namespace

Command add_run(CommandLine& app) {
  CommandLine command = app.add_command(
      "run", "Run a scene and write its run folder",
      "Examples:\n"
      "  polynya run scenes/sawamura2017-fig4b.json\n"
      "  polynya run scenes/level-plate.json --until 60 --out /tmp/plate --overwrite\n"
      "  polynya run scenes/level-plate.json --set ice.thickness_m=0.7 --set ships[0].position_m[1]=5\n");
  auto options = std::make_shared<RunOptions>();
  add_scene(command, options->scene);
  command.option("--out", &options->out, "DIR", "Folder to write the run to; runs/<scene name> if not given");
  command.option("--until", &options->until, "S", "Simulated time at which the run ends, instead of the scene's [s]",
                 between(1e-9, 1e7));
  command.option("--seed", &options->seed, "N", "Seed of all random draws, instead of the scene's",
                 whole(0, 9007199254740991));
  command.option("--panel", &options->panel, "M",
                 "Record the ice loads on panels of this length of all ships and structures in panels.csv [m]",
                 between(0.1, 1000));
  add_set(command, options->set);
  add_run_options(command, options->driver);
  command.flag("--overwrite", options->overwrite, "Replace the run that is already in the folder");
  return {command, [options] { return run(*options); }};
}

Command add_resume(CommandLine& app) {
  CommandLine command =
      app.add_command("resume", "Continue a run that was stopped, killed or ran out of disk space, or extend it",
                      "Examples:\n"
                      "  polynya resume runs/level-plate\n"
                      "  polynya resume runs/level-plate --until 900        extend a run, even a finished one\n"
                      "  polynya resume runs/level-plate --checkpoint runs/level-plate/checkpoint-000000012000.bin\n"
                      "  polynya resume runs/level-plate --from-failure     repeat only the step that failed\n");
  auto options = std::make_shared<ResumeOptions>();
  add_run_folder(command, options->folder);
  command.option("--checkpoint", &options->checkpoint, "FILE", "Checkpoint to continue from; the newest if not given");
  command.option("--until", &options->until, "S",
                 "Simulated time at which the run ends, instead of the run's own end [s]; gives the same bytes as a "
                 "run started with it",
                 between(1e-9, 1e7));
  command.flag("--from-failure", options->from_failure,
               "Repeat the step after the state in failure.bin to see the failure again; writes nothing",
               {.excludes = {"--checkpoint", "--until"}});
  add_run_options(command, options->driver);
  return {command, [options] { return resume(*options); }};
}

}  // namespace polynya::app
