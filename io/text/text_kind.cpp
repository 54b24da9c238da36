#include "io/text/text_kind.hpp"

#include <algorithm>
#include <string>

namespace polynya::io {
namespace {

/// Whether the first bracket of the line is closed by its last character.
bool is_one_object(std::string_view line) {
  if (line.front() != '{' || line.back() != '}') return false;
  int depth = 0;
  for (std::size_t at = 0; at < line.size(); ++at) {
    const char c = line[at];
    if (c == '"') {
      for (++at; at < line.size() && line[at] != '"'; ++at) {
        if (line[at] == '\\') ++at;
      }
    } else if (c == '{' || c == '[') {
      ++depth;
    } else if ((c == '}' || c == ']') && --depth == 0) {
      return at + 1 == line.size();
    }
  }
  return false;
}

bool is_continued(std::string_view line) {
  return std::string_view("]},:").find(line.front()) != std::string_view::npos ||
         std::string_view("[{,:").find(line.back()) != std::string_view::npos;
}

/// The name of a geometry, or any word with a bracket behind it.
bool begins_wkt(std::string_view line) {
  const auto end_of_word = static_cast<std::size_t>(std::ranges::find_if_not(line, is_letter) - line.begin());
  std::string word(line.substr(0, end_of_word));
  for (char& c : word) c = static_cast<char>(c & ~0x20);  // upper case
  const auto begins = [&](std::string_view name) { return word.starts_with(name); };
  if (begins("POLYGON") || begins("MULTIPOLYGON") || begins("GEOMETRYCOLLECTION") || begins("SRID") ||
      begins("POINT") || begins("LINESTRING") || begins("MULTIPOINT") || begins("MULTILINESTRING"))
    return true;
  return !word.empty() && trimmed(line.substr(end_of_word)).starts_with('(');
}

}  // namespace

bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//");
}

LineCounts count_lines(std::string_view text) {
  LineCounts counts;
  for_lines(text, [&counts](std::string_view whole_line, std::size_t) {
    const std::string_view line = trimmed(whole_line);
    if (counts.lines++ == 0) {
      counts.first_line = line;
      counts.is_wkt_first = begins_wkt(line);
    }
    if (is_one_object(line))
      ++counts.objects;
    else if (begins_wkt(line))
      ++counts.wkt;
    else if (is_continued(line))
      ++counts.continued;
  });
  return counts;
}

}  // namespace polynya::io
