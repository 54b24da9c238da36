#include <filesystem>

#include <fmt/format.h>

#include "app/carry_out.hpp"
#include "app/commands.hpp"
#include "app/console.hpp"
#include "app/load_scene.hpp"
#include "app/stop_signal.hpp"
#include "io/run_writer.hpp"
#include "simulation/simulation.hpp"

namespace polynya::app {

int run(const RunOptions& options) {
  const auto loaded = load_scene(options.scene, {.until = options.until, .seed = options.seed});
  if (!loaded) return loaded.error();
  print_hints(*loaded);
  const std::filesystem::path folder = options.out.empty()
                                           ? std::filesystem::path("runs") / loaded->scene.name
                                           : std::filesystem::path(options.out);
  watch_signals();
  auto writer = io::RunWriter::create(folder, options.overwrite, *loaded);
  if (!writer) {
    print_err("polynya: {}\n", writer.error());
    return kInputOutput;
  }
  return carry_out({*loaded, simulation::Simulation(loaded->scene), std::move(*writer)}, options.carry);
}

}  // namespace polynya::app
