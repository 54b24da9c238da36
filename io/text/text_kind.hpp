#pragma once

#include <algorithm>
#include <string_view>

namespace polynya::io {

inline constexpr std::string_view kBlanks = " \t\r\n";

/// Whether it is one of A to Z or a to z.
bool is_letter(char c);

/// A line without the blanks around it.
std::string_view trimmed(std::string_view line);

/// Whether a trimmed line is a comment: '#' or '//' to its end.
bool is_comment(std::string_view line);

/// Calls use(line, offset) for each line that is neither blank nor a comment.
template <class Use>
void for_lines(std::string_view text, Use use) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = text.substr(start, end - start);
    if (const auto words = trimmed(line); !words.empty() && !is_comment(words)) use(line, start);
    start = end + 1;
  }
}

/// What kinds of lines a text of floes has. Blank lines and comments do not count.
struct LineCounts {
  std::size_t lines = 0;
  std::size_t objects = 0;    ///< from '{' to its own '}': a line of NDJSON, sound or not
  std::size_t continued = 0;  ///< end or begin amid a value: lines of one JSON text
  std::size_t wkt = 0;        ///< begin with a WKT geometry
  std::string_view first_line;
  bool is_wkt_first = false;

  bool are_all_objects() const { return objects == lines && lines > 1; }
  bool are_mostly_objects() const { return objects > continued && lines > 1; }
};
LineCounts count_lines(std::string_view text);

}  // namespace polynya::io
