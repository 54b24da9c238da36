#pragma once

#include "io/json_value.hpp"
#include "io/problem_collector.hpp"
#include "io/scene_draft.hpp"

namespace polynya::io {

/// What no single field can tell: ice that would sink, a step too long for the speeds, invalid outlines,
/// floes that overlap each other or lie in a ship. Tells every problem with its place.
void check_scene(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems);

}  // namespace polynya::io
