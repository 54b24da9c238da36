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
  simulation::FloeId floe = 0;
  geometry::Polygon polygon_in_world;  ///< [m]
};

/// The file final.geojson of a run, which has the floating floes of one instant in the world. It is parsed one floe at
/// a time, because all floes of a large run need several times the memory of the file's text.
class FinalFloes {
 public:
  /// Reads the file. Returns nothing if the folder has no final.geojson, or if the run has no folder. The error names
  /// the file and the line.
  static Result<std::optional<FinalFloes>> read(const std::filesystem::path& run_folder);

  double time() const { return time_; }  ///< time of the instant [s]

  /// Calls use(floe) for each floe of the file. The error names the file and the line.
  Result<> for_each(const std::function<void(const FinalFloe&)>& use) const;

 private:
  FinalFloes(std::string name, std::string text) : name_(std::move(name)), text_(std::move(text)) {}
  std::string name_;  ///< name of the file, for messages
  std::string text_;
  double time_ = 0;  ///< [s]
};

}  // namespace polynya::io
