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

/// A floe of a file, in the scene's plane.
struct FileFloe {
  geometry::Polygon polygon;  ///< in house notation; valid where the file was imported [m]
  FloeProperties properties;
  std::uint32_t offset = 0;  ///< of its coordinates in the file
};

/// The ice of one entry of the scene's "floes". What a floe's feature gives comes before the entry's own, and
/// that before the scene's.
class GroupIce {
 public:
  /// The scene's ice is complete. Nothing where the entry's is wrong, which is reported; `path` is the
  /// entry's, `item` its JSON.
  static std::optional<GroupIce> of(const simulation::Scene& scene, const FloeGroup& group, const JsonValue& item,
                                    const std::string& path, ProblemCollector& problems);

  /// The index in the scene's own_ice of the floe that is added next.
  std::int32_t add_to(simulation::Scene& scene, const FloeProperties& given);

  /// What was drawn of each law, in the order of the properties.
  std::vector<IceReport> reports(std::size_t group) const;

  /// The entry's and the feature's properties of the floe that was added last; none where it has none.
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
  /// All of these outlive it. `files` gives the floe files that the scene names.
  FloeListReader(const FloeFiles& files, SceneDraft& draft, LoadedScene& loaded, ProblemCollector& problems)
      : files_(files), draft_(draft), loaded_(loaded), problems_(problems) {}

  /// Adds the floes of one entry, whose JSON is `item`, to the draft, and how they came to it to the loaded scene.
  void add(std::size_t index, FloeGroup group, const JsonValue& item);

  JsonValue written{JsonValue::Array{}};  ///< the entries, complete, files spelled out

 private:
  void add_floes(const LatticeInput& lattice);
  void add_floes(const RectangleInput& rectangle);
  void add_floes(const geometry::Polygon& polygon);
  void add_floes(FieldInput& field);
  void add_floes(ChannelInput& channel);  // channel_reader.cpp
  void add_floes(const FileInput& file);
  /// Floes that the entry stands for in the resolved scene too.
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
  /// Reports what is wrong with a member of the entry at hand: "lattice.size_m".
  void report(std::string_view key, std::string found, std::string allowed) const {
    ReportAt{problems_, *item_, path_}(key, std::move(found), std::move(allowed));
  }

  const FloeFiles& files_;
  SceneDraft& draft_;
  LoadedScene& loaded_;
  ProblemCollector& problems_;
  std::size_t index_ = 0;            ///< of the entry at hand
  const JsonValue* item_ = nullptr;  ///< its JSON
  std::string path_;                 ///< "floes[2]"
  int member_ = 0;                   ///< of the entry's floes, the next one's number
  FloeGroup group_;
  GroupIce ice_;
};

/// A rectangle along the axes, counter-clockwise from its corner with the least x and y.
geometry::Polygon rectangle(geometry::Point corner, geometry::Vector size);

/// The same region with rings that are not closed by a repeated first point, outer counter-clockwise, holes
/// clockwise. Which way rings run and whether they are closed are matters of notation; nothing else is
/// changed.
geometry::Polygon in_house_notation(geometry::Polygon polygon);

}  // namespace polynya::io
