#pragma once

#include <filesystem>
#include <string>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {

/// The floe files of a folder and what is below it. Names that leave it, also by links, are refused.
FloeFiles floe_files_in(std::filesystem::path folder);

/// Reads a scene: JSON, comments allowed. All problems at once, each with its place (docs/scene.md).
SceneOutcome read_scene_file(const std::filesystem::path& path, const SceneOverrides& overrides = {});

/// read_scene() for a text whose floe files are searched for in `folder`.
SceneOutcome read_scene(std::string text, const std::string& name, const std::filesystem::path& folder,
                        const SceneOverrides& overrides = {}, std::size_t longest = kLongestScene);

}  // namespace polynya::io
