#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"
#include "io/text/result.hpp"

namespace polynya::io {

/// A value in place of the scene's own, of one key by its path.
struct Assignment {
  std::string path;              ///< "ice.thickness_m", "ships[0].position_m[1]"
  JsonValue value;               ///< its offsets are in the text that the assignment was read from
  std::uint32_t key_offset = 0;  ///< in that text
  PlacedText text;
};

/// "ice.thickness_m=0.7": the value is JSON or, where it is not, a text without quotes. `option` is its name
/// in problems. The error says what is no KEY=VALUE.
Result<Assignment> parse_assignment(std::string_view words, std::string_view option = "--set");

/// One line of a file of cases: {"ice.thickness_m": 0.7, "seed": 3}. `line` counts from 1.
tl::expected<std::vector<Assignment>, Problem> parse_case(std::string_view text, const std::string& file, int line);

/// Puts the values into a scene before it is resolved, in order. Objects on the way are made where the scene
/// has none; what is no key of a scene is found when it is resolved. Items of lists must be there.
void assign(JsonValue& scene, const std::vector<Assignment>& assignments, ProblemCollector& problems);

}  // namespace polynya::io
