#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/load_scene.hpp"

namespace polynya::app {

int validate(const ValidateOptions& options) {
  const auto loaded = load_scene(options.scene);
  if (!loaded) return loaded.error();
  if (options.resolved) {
    fmt::print("{}", loaded->resolved_text);
    return kDone;
  }
  const simulation::Scene& scene = loaded->scene;
  fmt::print("{}: valid; \"{}\" with {} ship{} and {} floe{}, {:g} s in steps of {:g} s, hash {}\n",
             options.scene, scene.name, scene.ships.size(), scene.ships.size() == 1 ? "" : "s",
             scene.floes.size(), scene.floes.size() == 1 ? "" : "s", scene.time.until, scene.time.step,
             loaded->hash);
  return kDone;
}

}  // namespace polynya::app
