#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"

namespace polynya::io {

inline constexpr double kKnot = 1852.0 / 3600;  ///< [m/s]

/// ship_presets.json, which has what there is to know of them.
extern const std::string_view kShipPresets;

/// One particular of a preset: a scene key of a ship and its value.
struct PresetValue {
  std::string path;   ///< below the ship, as "hull.length_m"
  std::string json;   ///< its value, in the key's unit
  std::string basis;  ///< "published", "estimated", "assumed", "recall"
  std::string source;
};

/// What has been reported of a ship in level ice.
struct ReportedSpeed {
  double thickness = 0;          ///< [m]
  double speed = 0;              ///< [m/s]
  double flexural_strength = 0;  ///< 0: not stated [Pa]
  std::string source;
};

/// A ship whose particulars a scene can ask for by name, as "ship": "polaris".
struct ShipPreset {
  std::string name;
  std::string title;
  std::vector<PresetValue> particulars;
  std::vector<ReportedSpeed> reported;
};

std::span<const ShipPreset> ship_presets();

/// The preset of that name, or null.
const ShipPreset* find_ship_preset(std::string_view name);

/// Its particulars as a ship of a scene has them.
JsonValue json_of(const ShipPreset& preset);

/// Fills in the particulars of a scene's ships that ask for a preset, where the scene
/// gives none itself. What a scene gives of another kind (a constant speed for an engine, a waterline for
/// length and beam) stands instead. Values that are filled in are placed where the ship's preset is
/// named, and stand for that name.
void fill_in_presets(JsonValue& scene);

}  // namespace polynya::io
