#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "io/text/json_value.hpp"

namespace polynya::io {

inline constexpr double kKnot = 1852.0 / 3600;  ///< [m/s]

/// Where a ship's particular comes from.
enum class Basis {
  kPublished,  ///< by its owner, yard or operator
  kEstimated,  ///< from published ones
  kAssumed,    ///< nobody has published it
  kRecall,     ///< from memory
};
std::string_view name_of(Basis basis);

/// One particular of a preset: a scene key of a ship and its value.
struct Particular {
  std::string_view path;  ///< below the ship, as "hull.length_m"
  std::string_view json;  ///< its value, in the key's unit
  Basis basis = Basis::kAssumed;
  std::string_view source;
};

/// What has been reported of a ship in level ice.
struct ReportedSpeed {
  double thickness = 0;          ///< [m]
  double speed = 0;              ///< [m/s]
  double flexural_strength = 0;  ///< 0: not stated [Pa]
  std::string_view source;
};

/// A ship whose particulars a scene can ask for by name, as "ship": "polaris".
struct ShipPreset {
  std::string_view name;
  std::string_view title;
  std::vector<Particular> particulars;
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
