#pragma once

#include "io/text/json_value.hpp"

namespace polynya::io {

/// Fills in the particulars of a scene's ships that ask for a preset (ship_presets.hpp), where the scene
/// gives none itself. What a scene gives of another kind (a constant speed for an engine, a waterline for
/// length and beam) stands instead. Values that are filled in are placed where the ship's preset is
/// named, and stand for that name.
void fill_in_presets(JsonValue& scene);

}  // namespace polynya::io
