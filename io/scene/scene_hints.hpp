#pragma once

#include "io/scene/scene_input.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// What in a valid scene is probably not meant: a ship far from the weight of the water its hull displaces,
/// one that leaves all ice behind, speeds and thicknesses beyond those of ships and level ice, prescribed
/// courses that cross, no ice. Added to `hints` with their severity; a run is never refused for them.
void add_scene_hints(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& hints);

}  // namespace polynya::io
