#include <filesystem>
#include <memory>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/load_scene.hpp"
#include "app/options.hpp"
#include "app/run_driver.hpp"
#include "app/stop_signal.hpp"
#include "io/run/active_run.hpp"
#include "io/run/failure_dump.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/summary.hpp"

namespace polynya::app {
namespace {

namespace fs = std::filesystem;
using simulation::Simulation;

struct ResumeOptions {
  std::string folder;
  std::string checkpoint;     ///< empty: the newest
  bool from_failure = false;  ///< only repeats the step that a failure was dumped for
  DriverOptions driver;
};

/// Names the checkpoints that are left, where one was refused.
void offer_others(const fs::path& folder, const fs::path& refused) {
  for (const fs::path& other : io::checkpoints_in(folder)) {
    if (other.filename() == refused.filename()) continue;
    print_err("polynya: there is another: polynya resume {} --checkpoint {}\n", folder.string(),
              other.string());
  }
  print_err("polynya: or from the start: polynya run {} --out {} --overwrite\n",
            (folder / io::run_file::kScene).string(), folder.string());
}

/// The one step after a dump, and whether it fails as it did.
int repeat_failure(const io::LoadedScene& scene, const fs::path& folder) {
  const fs::path path = folder / io::run_file::kFailure;
  const auto dump = io::read_checkpoint_file(path, scene.hash);
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

/// Why there is nothing in a folder to resume.
std::string no_run_in(const fs::path& folder) {
  const std::string name = folder.string();
  if (io::is_marked_run_folder(folder))
    return fmt::format(
        "{0}: no run to resume: polynya was killed before it had written {1}; start the run again: polynya "
        "run "
        "SCENE --out {0} --overwrite",
        name, io::run_file::kScene);
  return fmt::format("{}: no run to resume: there is no {}", name, io::run_file::kScene);
}

/// A kill between the end of a run and the end of the command leaves checkpoints, or a part of the pictures.
int report_finished(const fs::path& folder, bool no_map) {
  print_err("polynya: {}: the run is finished; there is nothing to resume\n", folder.string());
  const bool is_drawn =
      fs::exists(folder / io::run_file::kFinalSvg) && fs::exists(folder / io::run_file::kFinalPng);
  if (is_drawn && io::checkpoints_in(folder).empty()) return kDone;
  const auto lock = io::RunLock::take(folder);
  if (!lock) return kDone;                            // another polynya holds it and does what is left
  static_cast<void>(io::remove_checkpoints(folder));  // a later command tries again
  if (is_drawn || no_map) return kDone;
  const DrawnMap map = draw_map(folder);
  if (map.end != io::RunEnd::kFinished) fail(kInputOutput, map.reason);
  return exit_code_of(map.end);
}

int resume_from_checkpoint(const io::LoadedScene& scene, io::RunLock lock, const ResumeOptions& options) {
  const fs::path folder = lock.folder();
  const std::vector<fs::path> checkpoints = io::checkpoints_in(folder);
  if (checkpoints.empty() && options.checkpoint.empty()) {
    print_err("polynya: {}: no checkpoint was written yet; from the start\n", folder.string());
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
  if (io::is_finished_run(folder)) return report_finished(folder, options.driver.no_map);
  auto lock = io::RunLock::take(folder);
  if (!lock) return fail(kInputOutput, lock.error());
  if (io::is_finished_run(folder))
    return report_finished(folder, options.driver.no_map);  // by another polynya meanwhile
  watch_signals();
  const auto scene = load_scene(scene_file.string(), {}, ProblemFormat::kText, options.driver.progress);
  return scene ? resume_from_checkpoint(*scene, std::move(*lock), options) : scene.error();
}

}  // namespace

Command add_resume(CommandLine& app) {
  CommandLine command = app.add_command(
      "resume", "Resume a run that was stopped, killed or ran out of disk",
      "Examples:\n"
      "  polynya resume runs/level-plate\n"
      "  polynya resume runs/level-plate --checkpoint runs/level-plate/checkpoint-000000012000.bin\n"
      "  polynya resume runs/level-plate --from-failure     only the step that failed, once more\n");
  auto options = std::make_shared<ResumeOptions>();
  command.option("folder", options->folder, "RUN", "The run folder").required();
  auto checkpoint =
      command.option("--checkpoint", options->checkpoint, "FILE", "This one, instead of the newest");
  command
      .flag("--from-failure", options->from_failure,
            "Repeat the step for which failure.bin was dumped; nothing is written")
      .excludes(checkpoint);
  add_run_options(command, options->driver);
  return {command, [options] { return resume(*options); }};
}

}  // namespace polynya::app
