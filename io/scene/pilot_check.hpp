#pragma once

#include "io/scene/scene_input.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// Finds whom ships follow. Reports pilots that cannot do what they are to do: without an engine or steering,
/// beyond the rudder's stop, on a route that begins behind the ship or leads through a structure, behind a
/// ship that is not there or that follows them.
void complete_pilots(const JsonValue& given, SceneDraft& draft, ProblemCollector& problems);

}  // namespace polynya::io
