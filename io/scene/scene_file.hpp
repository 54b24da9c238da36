#pragma once

#include <filesystem>
#include <string>

#include "io/scene/scene_reader.hpp"

namespace polynya::io {

/// Returns a function that reads the floe files of a folder and its subfolders, for read_scene(). Files that are not
/// GeoJSON, NDJSON or WKT are converted by GDAL. A name that is absolute or leads out of the folder, also by links, is
/// refused, so that a scene from somebody else cannot read other files. The function then fails with
/// FloeFileFailure::is_name true. It fails with false if the file cannot be read or converted, or is longer than
/// kLongestFloesFile. An empty folder is the current one.
FloeFiles floe_files_in(std::filesystem::path folder);

/// Reads a scene file, JSON with comments, and the floe files that it names, which lie in its folder. `overrides`
/// replace values of the file. Returns the scene, or all its problems, each with its place (docs/scene.md). A file that
/// cannot be read, or is longer than kLongestScene, is a single problem without a line.
SceneOutcome read_scene_file(const std::filesystem::path& path, const SceneOverrides& overrides = {});

/// Does the same for the text of a scene. `name` names it in messages, and the floe files that it names are searched
/// for in `folder` (empty: the current folder). A scene whose resolved text, with all floes, is longer than `longest`
/// [bytes] is refused.
SceneOutcome read_scene(std::string text, const std::string& name, const std::filesystem::path& folder,
                        const SceneOverrides& overrides = {}, std::size_t longest = kLongestScene);

}  // namespace polynya::io
