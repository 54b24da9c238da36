#pragma once

#include <optional>

#include "io/scene/scene_input.hpp"
#include "io/text/json_value.hpp"
#include "io/text/problem_collector.hpp"

namespace polynya::io {

/// The field that an entry asks for: its region, its seed, what ships keep clear, and the defaults that
/// depend on whether it has a size law; these are put into `input` too. Nothing where it cannot be made; what
/// is wrong has been reported at `path`. `item` is the entry's JSON.
std::optional<simulation::FloeField> complete_field(FieldInput& input, const JsonValue& item, const std::string& path,
                                                    const simulation::Scene& scene, ProblemCollector& problems);

/// Reports a cover that the field did not reach; true where there is none.
bool check_cover(const simulation::FloeField& field, const simulation::FloeFieldOutcome& outcome, const JsonValue& item,
                 const std::string& path, ProblemCollector& problems);

}  // namespace polynya::io
