#include "app/load_scene.hpp"

#include <cstdio>

#include <fmt/format.h>

namespace polynya::app {

std::optional<io::LoadedScene> load_scene(const std::string& file, const io::SceneOverrides& overrides) {
  auto loaded = io::read_scene_file(file, overrides);
  if (loaded) return std::move(*loaded);
  for (const io::Problem& problem : loaded.error()) fmt::print(stderr, "{}\n", to_string(problem));
  const std::size_t count = loaded.error().size();
  fmt::print(stderr, "polynya: {} problem{} in {}; nothing was written\n", count, count == 1 ? "" : "s",
             file);
  return std::nullopt;
}

}  // namespace polynya::app
