#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fracture/scatter.hpp"
#include "io/import/floe_import.hpp"
#include "io/import/floe_properties.hpp"
#include "io/scene/scene_input.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/problem.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// A floe of a file in the scene's plane.
struct FileFloe {
  geometry::Polygon polygon;  ///< in house notation, and valid if it was imported [m]
  FloeProperties properties;
  std::uint32_t offset = 0;  ///< position of its coordinates in the file [bytes]
};

/// Ice properties of the floes of one entry of the scene's "floes". A property of a floe is taken from its feature in
/// the file; if that has none, from the entry; if that has none, from the scene.
class GroupIce {
 public:
  /// Reads the ice of an entry. The scene's own ice must be complete. Returns nothing if the entry is wrong, which is
  /// reported; `path` and `item` are the path and the JSON of the entry.
  static std::optional<GroupIce> of(const simulation::Scene& scene, const FloeGroup& group, const JsonValue& item,
                                    const std::string& path, ProblemCollector& problems);

  /// Draws the properties of the next floe. Returns their index in own_ice of the scene.
  std::int32_t add_to(simulation::Scene& scene, const FloeProperties& given);

  /// Returns a summary of the values that were drawn from each law, in the order of the properties.
  std::vector<IceReport> reports(std::size_t group) const;

  /// Returns the properties that the entry and the feature give to the floe added last; nothing if they give none.
  std::optional<IceInput> spelled_out(const simulation::Scene& scene, const FloeProperties& given) const;

 private:
  struct Law {
    std::size_t property = 0;
    fracture::ScatterLaw law;
    std::vector<double> drawn;
  };
  std::vector<Law> laws_;
  std::uint64_t seed_ = 0;
};

/// Makes the floes of the scene's list: lattices, fields, files and single floes.
class FloeListReader {
 public:
  /// All arguments must exist longer than this object. `files` returns the floe files that the scene names.
  FloeListReader(const FloeFiles& files, SceneDraft& draft, LoadedScene& loaded, ProblemCollector& problems)
      : files_(files), draft_(draft), loaded_(loaded), problems_(problems) {}

  /// Adds the floes of one entry, whose JSON is `item`, to the draft, and reports on them to the loaded scene.
  void add(std::size_t index, FloeGroup group, const JsonValue& item);

  /// Entries of the resolved scene: complete, and with the floes of files in place of the files.
  JsonValue written{JsonValue::Array{}};

 private:
  void add_floes(const LatticeInput& lattice);
  void add_floes(const RectangleInput& rectangle);
  void add_floes(const geometry::Polygon& polygon);
  void add_floes(FieldInput& field);
  void add_floes(ChannelInput& channel);  // channel_reader.cpp
  void add_floes(const FileInput& file);
  /// Adds floes that the resolved scene represents by the same entry.
  void add_all(std::vector<geometry::Polygon> floes, bool are_known_valid);
  /// Makes a random field, whose problems are reported at `report`. Nothing where it is wrong.
  std::optional<simulation::FloeFieldOutcome> make_field(FieldInput& input, const ReportAt& report);
  bool check_channel(ChannelInput& channel, const ReportAt& report);
  void add_brash(ChannelInput& channel, const ReportAt& report);
  void add_consolidated(const ChannelInput& channel, const ReportAt& report);
  void add_fast_ice(const ChannelInput& channel);
  void add_fast(std::vector<geometry::Ring> rings, const FloeProperties& ice);
  void check_places(const FileReport& came, std::uint32_t offset);
  FloeGroup spelled_out(FileFloe& floe, bool is_of_run) const;
  void add_floe(const FloeGroup& group, geometry::Polygon polygon, const FloeProperties& given, Origin origin);
  void check_fast_ice(bool is_fast);
  int ship_over(const std::string& name, const Origin& origin);
  bool has_room_for(std::size_t count, const std::string& path);
  /// Reports a problem of a member of the present entry, such as "lattice.size_m".
  void report(std::string_view key, std::string found, std::string allowed) const {
    ReportAt{problems_, *item_, path_}(key, std::move(found), std::move(allowed));
  }

  const FloeFiles& files_;
  SceneDraft& draft_;
  LoadedScene& loaded_;
  ProblemCollector& problems_;
  std::size_t index_ = 0;            ///< index of the present entry
  const JsonValue* item_ = nullptr;  ///< JSON of the present entry
  std::string path_;                 ///< path of the present entry: "floes[2]"
  int member_ = 0;                   ///< number of the next floe of the present entry
  FloeGroup group_;
  GroupIce ice_;
};

/// Returns a rectangle along the axes, counter-clockwise from the corner with the smallest x and y.
geometry::Polygon rectangle(geometry::Point corner, geometry::Vector size);

/// Returns the same polygon in the notation of this program: rings are not closed by a repeated first point, the outer
/// ring runs counter-clockwise, holes clockwise. Only the notation changes.
geometry::Polygon in_house_notation(geometry::Polygon polygon);

}  // namespace polynya::io
