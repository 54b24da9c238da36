#pragma once

#include <filesystem>
#include <string>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {

/// Returns the floe files of a folder and its subfolders. Names that lead out of the folder, also by links, are
/// refused.
FloeFiles floe_files_in(std::filesystem::path folder);

/// Reads a scene file: JSON with comments. Returns the scene, or all its problems, each with its place (docs/scene.md).
SceneOutcome read_scene_file(const std::filesystem::path& path, const SceneOverrides& overrides = {});

/// Does the same for a text. The floe files that it names are searched for in `folder`.
SceneOutcome read_scene(std::string text, const std::string& name, const std::filesystem::path& folder,
                        const SceneOverrides& overrides = {}, std::size_t longest = kLongestScene);

}  // namespace polynya::io
