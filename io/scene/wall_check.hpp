#pragma once

#include "io/scene/scene_draft.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// Adds the wall that was read to the draft's ships, or reports why it is none.
void add_wall(std::size_t index, const JsonValue& item, SceneDraft& draft, ProblemCollector& problems);

/// What cannot be of walls together with the rest of the scene. Overlaps are found with those of all bodies.
void check_walls(const SceneDraft& draft, const JsonValue& resolved, ProblemCollector& problems);

/// The skin drag of the water where a wind blows and the scene has none of its own [-].
inline constexpr double kSkinDragInWind = 0.004;

/// Enters it into the resolved scene.
void choose_skin_drag(const JsonValue& root, JsonValue& resolved);

}  // namespace polynya::io
