#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/scene/floe_file.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/scene/scene_draft.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"
#include "io/text/result.hpp"

namespace polynya::io {

/// Makes the floes of the scene's list: lattices, fields, files and single floes. Files are spelled out in
/// the resolved list.
class FloeListReader {
 public:
  /// All of these outlive it. `folder` is the scene's.
  FloeListReader(const std::filesystem::path& folder, SceneDraft& draft, ProblemCollector& problems,
                 JsonValue& resolved, std::vector<FieldReport>& fields, std::vector<IceReport>& ice,
                 std::vector<FileReport>& files)
      : folder_(folder),
        draft_(draft),
        problems_(problems),
        resolved_(resolved),
        fields_(fields),
        ice_reports_(ice),
        files_(files) {}

  /// Adds the floes of one item of the list, which the draft's group holds.
  void add(std::size_t index, const JsonValue& item);

 private:
  void add_field(std::size_t index, const JsonValue& item);
  void add_file(std::size_t index, const JsonValue& item);
  void add_floes(std::size_t index, const JsonValue& item);
  JsonValue spelled_out(const FileFloe& floe, const JsonValue& item, bool is_of_run) const;
  static void fill_in(simulation::FloeSpec& spec, const JsonValue& entry);
  void add_floe(geometry::Polygon polygon, Origin origin);
  bool check_lattice(const JsonValue& item, const std::string& path);
  bool has_room_for(std::size_t count, const JsonValue& item, const std::string& path);
  Result<std::filesystem::path> locate(const std::string& name) const;
  void report(std::uint32_t offset, std::string path, std::string found, std::string allowed) {
    problems_.report(0, offset, std::move(path), std::move(found), std::move(allowed));
  }

  const std::filesystem::path& folder_;
  SceneDraft& draft_;
  ProblemCollector& problems_;
  JsonValue& resolved_;
  std::vector<FieldReport>& fields_;
  std::vector<IceReport>& ice_reports_;
  GroupIce ice_;  ///< of the item at hand
  std::vector<FileReport>& files_;
};

}  // namespace polynya::io
