#pragma once

#include "io/scene/scene_input.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// Refuses bodies that start faster than a run allows, and a step in which one moves as far as a contact
/// circle's radius. Speeds are those of rims, relative to the water; ships' include what thrust adds in the
/// first step.
void check_speeds(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems);

}  // namespace polynya::io
