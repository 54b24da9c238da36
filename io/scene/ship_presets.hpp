#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"

namespace polynya::io {

/// One knot [m/s]: a nautical mile of 1852 m per hour, by definition.
inline constexpr double kKnot = 1852.0 / 3600;

/// Contents of ship_presets.json, with all data of the presets and their sources. The build compiles the file into the
/// program, so that a changed preset needs a new build.
extern const std::string_view kShipPresets;

/// A value of a preset, for one key of a scene's ship.
struct PresetValue {
  std::string path;  ///< path of the key below the ship: "hull.length_m"
  std::string json;  ///< JSON of the value, in the unit at the end of the key
  /// How the value is known: "published" by the ship's owner, yard or operator; "estimated" from published values;
  /// "assumed", because nobody has published it; or "recall", from memory. Shown to users, without effect on a run.
  std::string basis;
  std::string source;  ///< key of docs/references.md or a remark, for people
};

/// A published speed of a ship in level ice. `polynya ships` shows it for comparison; no run uses it.
struct ReportedSpeed {
  double thickness = 0;          ///< thickness of the ice [m]
  double speed = 0;              ///< steady speed in that ice [m/s]; the file has knots
  double flexural_strength = 0;  ///< flexural strength of that ice [Pa]; 0: not stated
  std::string source;            ///< key of docs/references.md or a remark, for people
};

/// A ship that a scene selects by its name: "ship": "polaris".
struct ShipPreset {
  std::string name;                      ///< word with which a scene asks for the ship
  std::string title;                     ///< line for people in the list of `polynya ships`
  std::vector<PresetValue> particulars;  ///< all values that the preset gives to a scene's ship
  std::vector<ReportedSpeed> reported;   ///< may be empty
};

/// Returns all presets, in the order of ship_presets.json. They exist as long as the program.
std::span<const ShipPreset> ship_presets();

/// Returns the preset of that name, or null.
const ShipPreset* find_ship_preset(std::string_view name);

/// Returns the values of a preset as a ship of a scene: an object with the keys of "ships", without a name.
JsonValue json_of(const ShipPreset& preset);

/// Fills in the values of presets for ships of a scene that ask for one, and removes their key "ship". Values of the
/// scene take precedence, key by key, also inside of objects such as "hull". So do values of another alternative, such
/// as a constant speed instead of an engine, or a waterline instead of length and beam. A ship whose own propulsion is
/// something other than an engine does not get the preset's steering. A ship with an unknown preset gets the values of
/// the preset "reference", so that not everything is reported as missing, and keeps its key "ship", which is then
/// reported. Nothing is changed in a scene whose "ships" is no list. For messages, the filled-in values have the place
/// at which the scene names the preset.
void fill_in_presets(JsonValue& scene);

}  // namespace polynya::io
