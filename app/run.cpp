#include <filesystem>
#include <memory>
#include <new>
#include <utility>

#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/field_report.hpp"
#include "app/load_scene.hpp"
#include "app/memory_check.hpp"
#include "app/options.hpp"
#include "app/run_driver.hpp"
#include "app/stop_signal.hpp"
#include "io/run/run_writer.hpp"
#include "simulation/simulation.hpp"

namespace polynya::app {
namespace {

struct RunOptions {
  std::string scene;
  std::string out;              ///< empty: runs/<scene name>
  std::optional<double> until;  ///< [s]
  std::optional<std::uint64_t> seed;
  std::vector<io::Assignment> set;
  bool overwrite = false;
  DriverOptions driver;
};

/// A run before its first step. Whether it fits into memory is checked before anything is written.
struct Start {
  std::unique_ptr<io::LoadedScene> scene;
  std::unique_ptr<simulation::Simulation> simulation;
};

tl::expected<Start, ExitCode> start_of(const RunOptions& options) {
  try {
    auto loaded =
        load_scene(options.scene, {.until = options.until, .seed = options.seed, .assignments = options.set},
                   ProblemFormat::kText, options.driver.progress);
    if (!loaded) return tl::unexpected(loaded.error());
    print_hints(*loaded);
    print_fields(*loaded);
    if (!may_fit(loaded->scene, options.scene, memory_available())) return tl::unexpected(kOutOfMemory);
    print_folder_size(loaded->scene, options.driver.control.final_geojson);
    Start start;
    start.simulation = std::make_unique<simulation::Simulation>(loaded->scene);
    start.scene = std::make_unique<io::LoadedScene>(std::move(*loaded));
    return start;
  } catch (const std::bad_alloc&) {
    return tl::unexpected(fail(kOutOfMemory, fmt::format("{}: {}; nothing was written; {}", options.scene,
                                                         out_of_memory(), kToNeedLessMemory)));
  }
}

int run(const RunOptions& options) {
  const auto start = start_of(options);
  if (!start) return start.error();
  const std::filesystem::path folder = options.out.empty()
                                           ? std::filesystem::path("runs") / start->scene->scene.name
                                           : std::filesystem::path(options.out);
  watch_signals();
  auto writer = io::RunWriter::create(folder, options.overwrite, *start->scene);
  if (!writer) return fail(kInputOutput, writer.error());
  return drive_run({*start->scene, std::move(*start->simulation), std::move(*writer)}, options.driver);
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
  command.option("--out", options->out, "DIR", "The run folder; runs/<scene name> if not given");
  command.option("--until", options->until, "S", "Simulated time to run to, instead of the scene's [s]",
                 between(1e-9, 1e7));
  command.option("--seed", options->seed, "N", "Seed instead of the scene's", whole(0, 9007199254740991));
  add_set(command, options->set);
  add_run_options(command, options->driver);
  command.flag("--overwrite", options->overwrite, "Replace the run that is in the folder");
  return {command, [options] { return run(*options); }};
}

}  // namespace polynya::app
