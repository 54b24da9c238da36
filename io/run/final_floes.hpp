#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

#include "geometry/shape/polygon.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/journal.hpp"

namespace polynya::io {

/// A floe of final.geojson.
struct FinalFloe {
  simulation::FloeId floe = 0;         ///< id of the floe in its run (property floe_id of the file)
  geometry::Polygon polygon_in_world;  ///< outline in world coordinates, rings without a repeated first point [m]
};

/// The file final.geojson of a run: all floes that float at the end of the run, at their places in the world. Floes
/// under a hull are not in it. The text is kept in memory and parsed one floe at a time, because parsed floes of a
/// large run would need several times the memory of the text. This is a quick way to the last places of floes, without
/// reading the whole run folder.
class FinalFloes {
 public:
  /// Reads the file and the time in its first line. Returns nothing if the folder has no final.geojson, or if
  /// `run_folder` is empty, as for a run that was not read from a folder. Fails if the file cannot be read, is longer
  /// than kLongestRunFile, or is not written as a run writes it, with each floe on a line of its own. The error names
  /// the file, and the line unless the file could not be read. The lines of floes are not checked here; for_each() does
  /// that.
  static Result<std::optional<FinalFloes>> read(const std::filesystem::path& run_folder);

  double time() const { return time_; }  ///< simulated time at which the floes have these places [s]

  /// Calls use(floe) for each floe of the file, in its order. Stops at the first line that is not a floe, and fails
  /// with an error that names the file and the line; the floes before it have then been used already. If use() throws
  /// ReadError, that is reported in the same way; other exceptions pass through. A file without floes is no error.
  Result<> for_each(const std::function<void(const FinalFloe&)>& use) const;

 private:
  FinalFloes(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
  std::string name_;  ///< name of the file, for messages
  std::string text_;  ///< contents of the whole file
  double time_ = 0;   ///< [s]
};

}  // namespace polynya::io
