#pragma once

#include <string>

#include "io/scene/scene_draft.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// Water acts on the hulls of ships with an engine, unless the scene as given states otherwise.
void choose_hull_water(const JsonValue& root, JsonValue& resolved);

/// Fills in what follows from other particulars of the draft's last ship: mass, moment of inertia, bollard
/// pull, rudder, mooring. Reports what does not go together, at the ship's path.
void complete_ship(const JsonValue& item, const std::string& path, SceneDraft& draft,
                   ProblemCollector& problems);

/// Puts masses and moments of inertia that were left out into the resolved scene.
void fill_in_masses(const SceneDraft& draft, JsonValue& resolved);

}  // namespace polynya::io
