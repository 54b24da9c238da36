#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/import/floe_import.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/scene/scene_input.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/problem.hpp"
#include "io/text/source_text.hpp"

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
  FileReport report;  ///< without its group
};

/// Makes the floes of the scene's list: lattices, fields, files and single floes.
class FloeListReader {
 public:
  /// All of these outlive it. `folder` is the scene's.
  FloeListReader(const std::filesystem::path& folder, SceneDraft& draft, ProblemCollector& problems)
      : folder_(folder), draft_(draft), problems_(problems) {}

  /// Adds the floes of one entry, whose JSON is `item`.
  void add(std::size_t index, FloeGroup group, const JsonValue& item);

  JsonValue written{JsonValue::Array{}};  ///< the entries, complete, files spelled out
  std::vector<FieldReport> fields;
  std::vector<IceReport> ice;
  std::vector<FileReport> files;

 private:
  void add_floes(const LatticeInput& lattice);
  void add_floes(const RectangleInput& rectangle);
  void add_floes(const geometry::Polygon& polygon);
  void add_floes(FieldInput& field);
  void add_floes(const FileInput& file);
  /// Floes that the entry stands for in the resolved scene too.
  void add_all(std::vector<geometry::Polygon> floes, bool are_known_valid);
  FloeGroup spelled_out(FileFloe& floe, bool is_of_run) const;
  void add_floe(const FloeGroup& group, geometry::Polygon polygon, const FloeProperties& given, Origin origin);
  void check_fast_ice(bool is_fast);
  int ship_over(const std::string& name, const Origin& origin);
  bool has_room_for(std::size_t count, const std::string& path);
  Result<std::filesystem::path> locate(const std::string& name) const;
  /// Reports what is wrong with a member of the entry at hand: "lattice.size_m".
  void report(std::string_view key, std::string found, std::string allowed) const {
    ReportAt{problems_, *item_, path_}(key, std::move(found), std::move(allowed));
  }

  const std::filesystem::path& folder_;
  SceneDraft& draft_;
  ProblemCollector& problems_;
  std::size_t index_ = 0;            ///< of the entry at hand
  const JsonValue* item_ = nullptr;  ///< its JSON
  std::string path_;                 ///< "floes[2]"
  FloeGroup group_;
  GroupIce ice_;
};

/// A rectangle along the axes, counter-clockwise from its corner with the least x and y.
geometry::Polygon rectangle(geometry::Point corner, geometry::Vector size);

/// The same region with rings that are not closed by a repeated first point, outer counter-clockwise, holes
/// clockwise. Which way rings run and whether they are closed are matters of notation; nothing else is
/// changed.
geometry::Polygon in_house_notation(geometry::Polygon polygon);

/// Reads a floe file of a scene: GeoJSON, or what GDAL converts (io/import/foreign_file.hpp), brought to the
/// plane about the scene's origin. None where anything is wrong with it: then there are problems, of the file
/// or of the entry's `file` at `offset` in the scene.
std::optional<FloeFile> read_floe_file(const std::filesystem::path& file, const std::optional<FileImport>& import,
                                       const std::optional<simulation::GeographicOrigin>& origin,
                                       const std::string& path, std::uint32_t offset, ProblemCollector& problems);

}  // namespace polynya::io
