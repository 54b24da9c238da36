#pragma once

#include <functional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/import/gdal.hpp"

namespace polynya::io {

/// A floe file that a scene names, after it was read.
struct FloeFileText {
  std::string shown;                 ///< its name in messages
  std::string text;                  ///< GeoJSON, NDJSON or WKT
  bool is_foreign = false;           ///< true if GDAL wrote the text from another format
  std::string system{};              ///< coordinate system of a foreign file, as WKT; empty: it has none
  std::vector<std::string> notes{};  ///< messages about what was selected in a foreign file
};

/// Reason why a floe file cannot be read.
struct FloeFileFailure {
  bool is_name = false;  ///< true if the scene may not have a file of that name
  std::string shown;     ///< name of the file for messages
  std::string words;
};

/// Returns the text of a floe file by its name in the scene. The reader of scenes itself does not access a file system.
/// A caller with a file system passes floe_files_in() (io/scene/scene_file.hpp), one without passes no_floe_files().
using FloeFiles =
    std::function<tl::expected<FloeFileText, FloeFileFailure>(const std::string& name, const Selection& selection)>;

/// Refuses all files, for scenes that have no folder.
inline FloeFiles no_floe_files() {
  return [](const std::string& name, const Selection&) {
    return tl::unexpected(FloeFileFailure{true, name, "this scene has no folder"});
  };
}

}  // namespace polynya::io
