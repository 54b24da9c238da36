#pragma once

#include <optional>

#include "io/scene/scene_draft.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// Completes the field that the draft's group asks for: its region, seed, what ships keep clear, and the
/// defaults that depend on whether it has a size law; these are put into `item`, an entry of the resolved
/// "floes". Nothing where it cannot be made; what is wrong has been reported at `path`.
std::optional<simulation::FloeField> complete_field(JsonValue& item, const std::string& path,
                                                    const SceneDraft& draft, ProblemCollector& problems);

/// Reports a cover that the field did not reach; true where there is none.
bool check_cover(const simulation::FloeField& field, const simulation::FloeFieldOutcome& outcome,
                 const JsonValue& item, const std::string& path, ProblemCollector& problems);

}  // namespace polynya::io
