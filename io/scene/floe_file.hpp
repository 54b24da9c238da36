#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/import/floe_import.hpp"
#include "io/scene/scene_input.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// A floe of a file, in the scene's plane.
struct FileFloe {
  geometry::Polygon polygon;  ///< in house notation; valid where the file was imported [m]
  FloeProperties properties;
  std::uint32_t offset = 0;  ///< of its coordinates in the file
};

/// A floe file as a scene has it.
struct FloeFile {
  std::size_t source = 0;  ///< index in the ProblemCollector's sources
  std::vector<FileFloe> floes;
  std::optional<double> run_time;  ///< where the floes are those of a run at that time [s]
  PlaneReport plane;
  std::optional<ImportTotals> totals;  ///< where its entry has an "import"
  std::vector<NearMiss> near_misses;
};

/// Reads a floe file of a scene: GeoJSON, or what GDAL converts (io/import/foreign_file.hpp), brought to the
/// plane about the scene's origin. None where anything is wrong with it: then there are problems, of the file
/// or of the entry's `file` at `offset` in the scene.
std::optional<FloeFile> read_floe_file(const std::filesystem::path& file, const std::optional<FileImport>& import,
                                       const std::optional<simulation::GeographicOrigin>& origin,
                                       const std::string& path, std::uint32_t offset, ProblemCollector& problems);

}  // namespace polynya::io
