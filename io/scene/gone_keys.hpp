#pragma once

#include <string>
#include <string_view>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

/// A scene key of an earlier version that no longer exists.
struct GoneKey {
  std::string_view path;  ///< path of the key, without the numbers of list items
  /// True for values with which the scene has the same meaning if the key is removed.
  bool (*changes_nothing)(const JsonValue&) = {};
  std::string_view allowed = "";  ///< these values in words
  std::string_view instead = "";  ///< reason why the key was removed, and what to use instead
};

/// Returns the key of an earlier version that has this path, as "ships[1].calibration", or null if there is none.
const GoneKey* gone_key(std::string_view path);

/// Adds a hint for each key of an earlier version that a scene still has with a value that changes nothing.
void add_hints_at_gone_keys(const JsonValue& given, ProblemCollector& hints);

}  // namespace polynya::io
