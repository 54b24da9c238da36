#pragma once

#include <concepts>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "geometry/shape/point.hpp"

namespace polynya::io {

/// What a problem does to a file: an error refuses it, the others do not. In the order of name_of().
enum class Severity {
  kError,
  kWarning,  ///< it works, and is probably not meant
  kHint,     ///< it is unusual
};

std::string_view name_of(Severity severity);

/// One thing wrong in an input file, with its place.
struct Problem {
  std::string file = {};
  int line = 0;           ///< from 1; 0 where there is no place (an option on the command line)
  int column = 0;         ///< from 1, in characters; a tab is one
  std::string path = {};  ///< of the JSON value: "ships[0].hull.length_m"
  std::string found = {};
  std::string allowed = {};
  std::string suggestion = {};  ///< nearest known key or choice; empty where none is near
  std::string sentence = {};    ///< in place of found and allowed where those do not fit; else empty
  Severity severity = Severity::kError;
};

/// "found 0, allowed: a number > 0, ≤ 20 [m]"
std::string message_of(const Problem& problem);

/// "scene.json:12:5: ice.thickness_m: found 0, allowed: a number > 0, ≤ 20 [m]"; what is no error has its
/// severity behind the place: "scene.json:9:3: hint: ice.thickness_m: …"
std::string to_string(const Problem& problem);

/// A JSON array of them, one a line: file, line and column (null where there is no place), path, severity and
/// message.
std::string to_json_text(const std::vector<Problem>& problems);

/// " at (5, 5), (0, 0)": the first few of what is wrong, for messages; empty where there are none.
std::string places_in_words(std::span<const geometry::Point> places, std::size_t most);

/// "1 floe", "2 floes"; "1 box", "2 boxes" where the plural is given.
template <std::integral Count>
std::string counted(Count count, std::string_view noun, std::string_view plural = {}) {
  return fmt::format("{} {}{}", count, count == 1 || plural.empty() ? noun : plural,
                     count == 1 || !plural.empty() ? "" : "s");
}

/// A text of at most `most` bytes, cut between two characters and then ended by "…".
std::string shortened(std::string_view text, std::size_t most);

/// The candidate fewest edits away from a word, or "" where none is near enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string_view>& candidates);

}  // namespace polynya::io
