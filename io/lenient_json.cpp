#include "io/lenient_json.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>

#include "io/json_fault.hpp"
#include "io/json_parser.hpp"
#include "io/source_text.hpp"

namespace polynya::io {
namespace {

bool is_not_finite(const std::string& token) {
  const char* const start = token.c_str();
  char* end = nullptr;
  const double value = std::strtod(start, &end);  // reads NaN and Infinity too
  return end == start + token.size() && !std::isfinite(value);
}

/// Puts an empty text, with blanks for its length, in place of every number that is not finite.
void blank_unfinite(std::string& text) {
  constexpr std::string_view kOfTokens = "+-.0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";
  for (std::size_t at = 0; at < text.size();) {
    if (text[at] == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\') ++at;
      }
      ++at;
    } else if (text.compare(at, 2, "//") == 0) {
      at = std::min(text.find('\n', at), text.size());
    } else if (text.compare(at, 2, "/*") == 0) {
      at = std::min(text.find("*/", at + 2), text.size() - 2) + 2;
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

tl::expected<JsonValue, std::string> parse_lenient_json(std::string text) {
  JsonDocument document = parse_json(text);
  if (!document.faults.empty()) {
    blank_unfinite(text);
    document = parse_json(text);
  }
  if (document.faults.empty()) return std::move(document.root);
  const JsonFault& fault = document.faults.front();
  const LineAndColumn place = line_and_column(text, fault.offset);
  return tl::unexpected(fmt::format("{}:{}: {}", place.line, place.column, message_of(fault)));
}

}  // namespace polynya::io
