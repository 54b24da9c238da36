#pragma once

#include <functional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/import/gdal.hpp"

namespace polynya::io {

/// A floe file that a scene names, after it was read.
struct FloeFileText {
  std::string shown;                 ///< its name in messages, usually the path of the file
  std::string text;                  ///< GeoJSON, NDJSON or WKT
  bool is_foreign = false;           ///< true if GDAL wrote the text from another format
  std::string system{};              ///< coordinate system of a foreign file, as WKT; empty: it has none
  std::vector<std::string> notes{};  ///< messages about what was selected in a foreign file and what was left out
};

/// Reason why a floe file cannot be read. The reader of scenes reports it at the entry's "file", and refuses the scene.
struct FloeFileFailure {
  /// True: the name is not allowed, for example outside the scene's folder. False: the file is missing, too large or
  /// cannot be read. The message states accordingly what is allowed: a place or a size.
  bool is_name = false;
  std::string shown;  ///< name of the file for messages
  std::string words;  ///< the reason, for the message
};

/// Function that returns the text of a floe file by its name in the scene. If GDAL reads the file, the text has only
/// the features that `selection` selects; in other files the function ignores `selection`, and the reader of scenes
/// selects features itself. That reader does not access a file system. A caller with a file system passes
/// floe_files_in() (io/scene/scene_file.hpp), one without passes no_floe_files().
using FloeFiles =
    std::function<tl::expected<FloeFileText, FloeFileFailure>(const std::string& name, const Selection& selection)>;

/// Returns a function that refuses all files, for scenes that have no folder, such as those made in memory.
inline FloeFiles no_floe_files() {
  return [](const std::string& name, const Selection&) {
    return tl::unexpected(FloeFileFailure{true, name, "this scene has no folder"});
  };
}

}  // namespace polynya::io
