#include "app/load_scene.hpp"

#include <filesystem>
#include <utility>

#include "app/console.hpp"
#include "app/read_input.hpp"

namespace polynya::app {

void print_problems(const std::string& name, const std::vector<io::Problem>& problems) {
  for (const io::Problem& problem : problems) print_err("{}\n", to_string(problem));
  print_err("polynya: {} in {}; nothing was written\n", counted(problems.size(), "problem"), name);
}

tl::expected<io::LoadedScene, ExitCode> load_scene(const std::string& file,
                                                   const io::SceneOverrides& overrides, ProblemFormat format,
                                                   ProgressKind progress) {
  const bool is_json = format == ProblemFormat::kJson;
  const std::string name = file == "-" ? "stdin" : file;
  auto text =
      with_progress(progress, "reading the scene", [&] { return read_input(file, io::kLongestScene); });
  if (!text) {
    if (is_json) write_out(io::to_json_text({{.file = name, .sentence = text.error()}}));
    return tl::unexpected(fail(kInputOutput, fmt::format("{}: {}", name, text.error())));
  }
  auto loaded = with_progress(progress, "making the scene", [&] {
    return io::read_scene(std::move(*text), name, std::filesystem::path(file).parent_path(), overrides);
  });
  if (loaded) return std::move(*loaded);
  if (is_json)
    write_out(io::to_json_text(loaded.error()));
  else
    print_problems(name, loaded.error());
  return tl::unexpected(kSceneInvalid);
}

void print_hints(const io::LoadedScene& scene) {
  for (const io::Problem& hint : scene.hints) print_err("{}\n", to_string(hint));
}

}  // namespace polynya::app
