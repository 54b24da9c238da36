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

/// A floe of a floe file, moved to the scene's plane.
struct FileFloe {
  geometry::Polygon polygon;  ///< in house notation; valid if the entry has an "import", otherwise to be checked [m]
  FloeProperties properties;  ///< own properties of the floe; those that it does not have are taken from the entry
  std::uint32_t offset = 0;   ///< position of its coordinates in the file [bytes]
};

/// Chooses the ice properties of the floes of one entry of the scene's "floes". Each property of a floe is taken from
/// its feature in the floe file; if that has none, from the entry, which gives a number or a law from which a value is
/// drawn for each floe; if that has none, from the scene.
class GroupIce {
 public:
  /// Reads the "ice" of an entry, `group`; an entry without one gives no property. The scene's own ice must have been
  /// read, because it is the default mean of laws. Returns nothing if a law is wrong, which is reported. `path`
  /// ("floes[2]") and `item` are the path and the JSON of the entry, for messages.
  static std::optional<GroupIce> of(const simulation::Scene& scene, const FloeGroup& group, const JsonValue& item,
                                    const std::string& path, ProblemCollector& problems);

  /// Chooses the ice of the next floe of the scene, and adds it to own_ice of the scene unless it equals the scene's
  /// ice or the last one in own_ice. `given` are the properties of the floe's feature. Returns the index in own_ice, or
  /// kSceneIce. Draws depend on the seeds, the number of the floe in the scene and the property, so that a change of
  /// one law does not change the values that other laws give.
  std::int32_t add_to(simulation::Scene& scene, const FloeProperties& given);

  /// Returns a summary of the values that were drawn from each law, in the order of the properties. Constants, and laws
  /// from which nothing was drawn, are left out. `group` is the index of the entry, for the reports.
  std::vector<IceReport> reports(std::size_t group) const;

  /// Returns the properties that the entry and the feature give to the floe added last, as numbers, for the resolved
  /// scene; nothing if they give none. `given` are again the properties of the floe's feature.
  std::optional<IceInput> spelled_out(const simulation::Scene& scene, const FloeProperties& given) const;

 private:
  /// The law of one property, and what it gave.
  struct Law {
    std::size_t property = 0;   ///< index in floe_ice_properties()
    fracture::ScatterLaw law;   ///< a number is a constant law
    std::vector<double> drawn;  ///< values drawn so far, in SI units
  };
  std::vector<Law> laws_;   ///< one for each property that the entry gives
  std::uint64_t seed_ = 0;  ///< seed of the scene + seed of the entry's ice
};

/// Makes the floes of the scene's "floes": lattices, random fields, channels of brash ice, floe files and single floes.
/// Also makes the list of entries by which the resolved scene represents them.
class FloeListReader {
 public:
  /// All arguments must exist longer than this object. `files` returns the floe files that the scene names. The scene
  /// of `draft` must be complete except for its floes, because entries depend on its ice, water and hulls.
  FloeListReader(const FloeFiles& files, SceneDraft& draft, LoadedScene& loaded, ProblemCollector& problems)
      : files_(files), draft_(draft), loaded_(loaded), problems_(problems) {}

  /// Adds the floes of one entry to the draft. `index` is its index in "floes", `group` the entry as it was read, and
  /// `item` its JSON, for messages. Adds reports on fields, files and ice to the loaded scene. Problems of the entry
  /// are reported. An entry with a problem may add none or only some of its floes; the caller must then refuse the
  /// scene.
  void add(std::size_t index, FloeGroup group, const JsonValue& item);

  /// Entries of the resolved scene, so far: with all defaults, and with one entry for each floe of a file in place of
  /// the file, so that the scene of a run does not depend on other files.
  JsonValue written{JsonValue::Array{}};

 private:
  // One for each form of an entry.
  void add_floes(const LatticeInput& lattice);
  void add_floes(const RectangleInput& rectangle);
  void add_floes(const geometry::Polygon& polygon);
  void add_floes(FieldInput& field);
  void add_floes(ChannelInput& channel);  // channel_reader.cpp
  void add_floes(const FileInput& file);
  /// Adds floes that the resolved scene represents by the present entry itself, because it makes the same floes again.
  /// `are_known_valid`: the outlines are valid by construction and need no check.
  void add_all(std::vector<geometry::Polygon> floes, bool are_known_valid);
  /// Makes a random field, and sets the defaults of `input`. Returns nothing if the field is wrong or does not reach
  /// its concentration, which is reported at `report`, or if the scene has other problems already, because a large
  /// field takes long.
  std::optional<simulation::FloeFieldOutcome> make_field(FieldInput& input, const ReportAt& report);
  /// Sets the defaults of a channel, and reports keys that exclude each other. Returns true if there is no problem.
  bool check_channel(ChannelInput& channel, const ReportAt& report);
  /// Adds the brash of a channel as pieces.
  void add_brash(ChannelInput& channel, const ReportAt& report);
  /// Adds a frozen channel as one plate of fast ice.
  void add_consolidated(const ChannelInput& channel, const ReportAt& report);
  /// Adds the strips of fast ice beside a channel.
  void add_fast_ice(const ChannelInput& channel);
  /// Adds fast ice at rest with these outlines.
  void add_fast(std::vector<geometry::Ring> rings, const FloeProperties& ice);
  /// Reports a floe file in metres of another plane than an earlier file, because their places relative to each other
  /// would be wrong. With an origin in the scene, or if the file states no plane, nothing is reported. `offset` is that
  /// of its name in the scene.
  void check_places(const FileReport& came, std::uint32_t offset);
  /// Returns the entry by which the resolved scene represents one floe of a file, with the polygon of the floe, which
  /// is moved there. Properties of the floe replace those of the present entry. `is_of_run`: a run wrote the file;
  /// overlaps of its floes are then accepted, because crushing leaves them.
  FloeGroup spelled_out(FileFloe& floe, bool is_of_run) const;
  /// Adds one floe to the draft, with the motion of `group`. `given` are its own ice properties; its other properties
  /// must already be in `group`.
  void add_floe(const FloeGroup& group, geometry::Polygon polygon, const FloeProperties& given, Origin origin);
  /// Reports what fast ice must not have, if `is_fast`: a rotation of the entry, and contact.law impulse.
  void check_fast_ice(bool is_fast);
  /// Returns the index of the ship with this name under whose hull a floe is; −1, and a report at `origin`, if there is
  /// no such ship or if it has no draught.
  int ship_over(const std::string& name, const Origin& origin);
  /// Returns true if the scene may have `count` more floes (kMostFloes in all); otherwise reports at `path` that there
  /// would be too many.
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
  int member_ = 0;                   ///< number of the next floe of the present entry, for channels
  FloeGroup group_;                  ///< the present entry, with the defaults that have been set so far
  GroupIce ice_;                     ///< ice of the present entry
};

/// Returns a rectangle along the axes, counter-clockwise from `corner` [m], which has the smallest x and y. `size` is
/// its length along x and along y [m].
geometry::Polygon rectangle(geometry::Point corner, geometry::Vector size);

/// Returns the same polygon in the notation of this program: rings are not closed by a repeated first point, the outer
/// ring runs counter-clockwise, holes clockwise. Only the notation changes.
geometry::Polygon in_house_notation(geometry::Polygon polygon);

}  // namespace polynya::io
