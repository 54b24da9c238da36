#include "io/text/lenient_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "io/text/json_fault.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

bool is_not_finite(const std::string& token) {
  const char* const start = token.c_str();
  char* end = nullptr;
  const double value = std::strtod(start, &end);  // reads NaN and Infinity too
  return end == start + token.size() && !std::isfinite(value);
}

constexpr std::string_view kOfTokens = "+-.0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

std::size_t end_of_text(std::string_view text, std::size_t at) {
  for (++at; at < text.size() && text[at] != '"'; ++at) {
    if (text[at] == '\\') ++at;
  }
  return std::min(at + 1, text.size());
}

/// Behind the comment that begins there; the offset itself where none does.
std::size_t end_of_comment(std::string_view text, std::size_t at) {
  if (text.substr(at, 2) == "//") return std::min(text.find('\n', at), text.size());
  if (text.substr(at, 2) == "/*") return std::min(text.find("*/", at + 2), text.size() - 2) + 2;
  return at;
}

/// Puts an empty text, with blanks for its length, in place of every number that is not finite.
void blank_unfinite(std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '"') {
      at = end_of_text(text, at);
    } else if (const std::size_t behind = end_of_comment(text, at); behind > at) {
      at = behind;
    } else if (kOfTokens.find(text[at]) != std::string_view::npos) {
      const std::size_t end = std::min(text.find_first_not_of(kOfTokens, at), text.size());
      if (end - at >= 3 && is_not_finite(text.substr(at, end - at))) {
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at),
                  text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
        text[at] = text[at + 1] = '"';
      }
      at = end;
    } else {
      ++at;
    }
  }
}

}  // namespace

Result<JsonValue> parse_lenient_json(const std::string& text) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) {
    std::string blanked = text;
    blank_unfinite(blanked);
    document = parse_json(blanked);
  }
  if (document.faults.empty()) return std::move(document.root);
  const JsonFault& fault = document.faults.front();
  const LineAndColumn place = line_and_column(text, fault.offset);
  return fail(fmt::format("{}:{}: {}", place.line, place.column, message_of(fault)));
}

std::string compact_json(std::string_view text, std::size_t offset) {
  std::string compact;
  int depth = 0;
  for (std::size_t at = offset; at < text.size();) {
    std::size_t end = at + 1;
    const char c = text[at];
    if (c == '"') {
      end = end_of_text(text, at);
      compact += text.substr(at, end - at);
    } else if (kOfTokens.find(c) != std::string_view::npos) {
      end = std::min(text.find_first_not_of(kOfTokens, at), text.size());
      const std::string token(text.substr(at, end - at));
      compact += is_not_finite(token) ? "null" : token;
    } else if (const std::size_t behind = end_of_comment(text, at); behind > at) {
      at = behind;
      continue;
    } else if (std::string_view("[]{},:").find(c) != std::string_view::npos) {
      if (c == '[' || c == '{') ++depth;
      if (c == ']' || c == '}') --depth;
      compact += c;
    } else {  // a blank
      ++at;
      continue;
    }
    at = end;
    if (depth == 0) break;
  }
  return compact;
}

}  // namespace polynya::io
