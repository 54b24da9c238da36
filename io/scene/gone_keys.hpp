#pragma once

#include <string>
#include <string_view>

#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {

/// A scene key of an earlier version that no longer exists. The scene.json of older runs has such keys. A scene that
/// has one with a value that changes nothing is still accepted, with a hint. With another value it is refused, because
/// the scene would now mean something else. If a key is removed from the list, it is refused as an unknown key.
struct GoneKey {
  std::string_view path;  ///< path of the key without the numbers of list items: "ships.calibration"
  /// Returns true for values with which the scene has the same meaning if the key is removed. It must be set, because
  /// it is called without a check.
  bool (*changes_nothing)(const JsonValue&) = {};
  /// These values in words, for the message about another value. Empty only if every value changes nothing.
  std::string_view allowed = "";
  std::string_view instead = "";  ///< reason why the key was removed, and what to use instead, for the hint
};

/// Returns the key of an earlier version that has this path, for example "ships[1].calibration", or null if there is
/// none.
const GoneKey* gone_key(std::string_view path);

/// Adds a hint, with the place of the key, for each key of an earlier version that a valid scene still has. `given` is
/// the JSON of the scene with the values that override it. Only its members time, fracture and ships are searched, so a
/// gone key elsewhere would get no hint.
void add_hints_at_gone_keys(const JsonValue& given, ProblemCollector& hints);

}  // namespace polynya::io
