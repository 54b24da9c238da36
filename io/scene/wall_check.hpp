#pragma once

#include "io/scene/scene_input.hpp"

namespace polynya::io {

/// Adds a wall to the draft's ships, or reports why it is none.
void add_wall(std::size_t index, const JsonValue& item, const WallInput& wall, SceneDraft& draft,
              ProblemCollector& problems);

/// What cannot be of walls together with the rest of the scene. Overlaps are found with those of all bodies.
void check_walls(const SceneDraft& draft, const JsonValue& given, ProblemCollector& problems);

}  // namespace polynya::io
