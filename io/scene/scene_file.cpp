#include "io/scene/scene_file.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/import/gdal.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

namespace fs = std::filesystem;

/// Returns the path of a file that the scene names. Fails if it leads out of the scene's folder, also by links.
Result<fs::path> located(const fs::path& scene_folder, const std::string& name) {
  std::error_code error;
  if (name.empty() || fs::path(name).is_absolute()) return fail("not a relative path");
  const fs::path folder = fs::canonical(scene_folder.empty() ? "." : scene_folder, error);
  if (error) return fail(error.message());
  const fs::path target = fs::weakly_canonical(folder / name, error);
  if (error) return fail(error.message());
  const auto [end, unused] = std::ranges::mismatch(folder, target);
  if (end != folder.end()) return fail("it leaves the scene's folder");
  return scene_folder / name;
}

tl::expected<FloeFileText, FloeFileFailure> text_in(const fs::path& file, const Selection& selection) {
  const auto failed = [&](std::string words) {
    return tl::unexpected(FloeFileFailure{false, file.string(), std::move(words)});
  };
  auto foreign = read_foreign_file(file, selection, kLongestFloesFile);
  if (foreign && !*foreign) return failed(foreign->error());
  if (foreign)
    return FloeFileText{file.string(), std::move((*foreign)->geojson), true, std::move((*foreign)->system),
                        std::move((*foreign)->notes)};
  auto text = read_text_file(file, kLongestFloesFile);
  if (!text) return failed(text.error());
  return FloeFileText{file.string(), *std::move(text)};
}

}  // namespace

FloeFiles floe_files_in(fs::path folder) {
  return [folder = std::move(folder)](const std::string& name,
                                      const Selection& selection) -> tl::expected<FloeFileText, FloeFileFailure> {
    const auto file = located(folder, name);
    if (!file) return tl::unexpected(FloeFileFailure{true, name, file.error()});
    return text_in(*file, selection);
  };
}

SceneOutcome read_scene(std::string text, const std::string& name, const fs::path& folder,
                        const SceneOverrides& overrides, std::size_t longest) {
  return read_scene(std::move(text), name, floe_files_in(folder), overrides, longest);
}

SceneOutcome read_scene_file(const fs::path& path, const SceneOverrides& overrides) {
  auto text = read_text_file(path, kLongestScene);
  if (!text) {
    return tl::unexpected(std::vector<Problem>{{.file = path.string(),
                                                .found = text.error(),
                                                .allowed = fmt::format("a scene of at most {} bytes", kLongestScene)}});
  }
  return read_scene(std::move(*text), path.string(), path.parent_path(), overrides);
}

}  // namespace polynya::io
