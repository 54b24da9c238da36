#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"

namespace polynya::io {

inline constexpr double kKnot = 1852.0 / 3600;  ///< one knot [m/s]

/// Contents of ship_presets.json, with all data of the presets and their sources.
extern const std::string_view kShipPresets;

/// A value of a preset, for one key of a scene's ship.
struct PresetValue {
  std::string path;   ///< path of the key below the ship: "hull.length_m"
  std::string json;   ///< JSON of the value, in the key's unit
  std::string basis;  ///< how the value is known: "published", "estimated", "assumed" or "recall"
  std::string source;
};

/// A published speed of a ship in level ice.
struct ReportedSpeed {
  double thickness = 0;          ///< [m]
  double speed = 0;              ///< [m/s]
  double flexural_strength = 0;  ///< [Pa]; 0: not stated
  std::string source;
};

/// A ship that a scene selects by its name: "ship": "polaris".
struct ShipPreset {
  std::string name;
  std::string title;
  std::vector<PresetValue> particulars;
  std::vector<ReportedSpeed> reported;
};

std::span<const ShipPreset> ship_presets();

/// Returns the preset of that name, or null.
const ShipPreset* find_ship_preset(std::string_view name);

/// Returns the values of a preset as a ship of a scene.
JsonValue json_of(const ShipPreset& preset);

/// Fills in the values of presets for ships of a scene that ask for one. Values of the scene take precedence. So do
/// values of another alternative, such as a constant speed instead of an engine, or a waterline instead of length and
/// beam. A ship without an engine does not get the preset's steering. A ship with an unknown preset gets the values of
/// the preset "reference" and keeps its key "ship", which is then reported. For messages, the filled-in values have the
/// place at which the scene names the preset.
void fill_in_presets(JsonValue& scene);

}  // namespace polynya::io
