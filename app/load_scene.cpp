#include "app/load_scene.hpp"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "app/console.hpp"
#include "io/source_text.hpp"

namespace polynya::app {

tl::expected<io::LoadedScene, ExitCode> load_scene(const std::string& file,
                                                   const io::SceneOverrides& overrides) {
  auto text = io::read_text_file(file, io::kLongestScene);
  if (!text) {
    print_err("polynya: {}: {}\n", file, text.error());
    return tl::unexpected(kInputOutput);
  }
  auto loaded = io::read_scene(std::move(*text), file, std::filesystem::path(file).parent_path(), overrides);
  if (loaded) return std::move(*loaded);
  for (const io::Problem& problem : loaded.error()) print_err("{}\n", to_string(problem));
  const std::size_t count = loaded.error().size();
  print_err("polynya: {} problem{} in {}; nothing was written\n", count, count == 1 ? "" : "s", file);
  return tl::unexpected(kSceneInvalid);
}

}  // namespace polynya::app
