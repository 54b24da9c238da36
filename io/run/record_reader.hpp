#pragma once

#include <stdexcept>
#include <string_view>
#include <vector>

#include "io/run/force_columns.hpp"
#include "io/run/run_reader.hpp"
#include "io/text/json_value.hpp"

namespace polynya::io {

// The lines that records.hpp writes, read back. Each throws ReadError where a line is not what it should be.

/// What is wrong with a line or a file.
struct ReadError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

JsonValue json_of(std::string_view text);
const JsonValue& json_member(const JsonValue& value, std::string_view key, JsonValue::Kind kind);
simulation::FloeId floe_id(const JsonValue& value);
geometry::Point point(const JsonValue& value);
/// −1 where the scene has no ship or structure of that name.
int ship_index(const simulation::Scene& scene, std::string_view name);

simulation::BirthRecord birth_of(const JsonValue& line);
simulation::HullSample sample_of(std::string_view line, const std::vector<const ForceColumn*>& columns,
                                 const simulation::Scene& scene);
/// `run` has its scene and its floes.
RunCrushed crushed_of(std::string_view line, const Run& run);
RunContact contact_of(std::string_view line, const Run& run);

}  // namespace polynya::io
