#pragma once

#include <functional>
#include <string>
#include <vector>

#include <tl/expected.hpp>

#include "io/import/gdal.hpp"

namespace polynya::io {

/// A floe file that a scene names, as it was found.
struct FloeFileText {
  std::string shown;               ///< its name in messages
  std::string text;                ///< GeoJSON, NDJSON or WKT
  bool is_foreign = false;         ///< true if GDAL wrote the text from another format
  std::string system;              ///< coordinate system of a foreign file, as WKT; empty: it has none
  std::vector<std::string> notes;  ///< for people: what was selected of a foreign file
};

/// Why a floe file cannot be had.
struct FloeFileFailure {
  bool is_name = false;  ///< true if the name is none of a file that the scene may have
  std::string shown;     ///< the file's name in messages
  std::string words;
};

/// Gives the text of a floe file by its name in the scene. The reader of scenes touches no file system itself: a caller
/// with one gives floe_files_in() (io/scene/scene_file.hpp), a caller without one gives no_floe_files().
using FloeFiles =
    std::function<tl::expected<FloeFileText, FloeFileFailure>(const std::string& name, const Selection& selection)>;

/// For scenes that may name no files.
inline FloeFiles no_floe_files() {
  return [](const std::string& name, const Selection&) {
    return tl::unexpected(FloeFileFailure{true, name, "this scene has no folder"});
  };
}

}  // namespace polynya::io
