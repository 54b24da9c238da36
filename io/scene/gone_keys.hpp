#pragma once

#include <string>
#include <string_view>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

/// A scene key of an earlier version that scenes no longer have.
struct GoneKey {
  std::string_view path;                           ///< path of the key, without the numbers of list items
  bool (*changes_nothing)(const JsonValue&) = {};  ///< true for a value with which a scene means the same without it
  std::string_view allowed = "";                   ///< such values, in words
  std::string_view instead = "";                   ///< why the key went, and what to use instead
};

/// Returns the key of an earlier version that has this path, as "ships[1].calibration", or null if there is none.
const GoneKey* gone_key(std::string_view path);

/// Adds a hint for each key of an earlier version that a scene still has with a value that changes nothing.
void add_hints_at_gone_keys(const JsonValue& given, ProblemCollector& hints);

}  // namespace polynya::io
