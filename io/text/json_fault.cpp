#include "io/text/json_fault.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

constexpr auto kAnyValue = "an object, a list, text in double quotes, a number, true, false or null";

/// The word or sign at an offset, on one line.
std::string show_at(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return "the end of the text";
  if (std::string_view("[]{},:").find(text[offset]) != std::string_view::npos)
    return fmt::format("'{}'", text[offset]);
  std::size_t end = text.find_first_of(" \t\r\n,:[]{}\"", offset + 1);
  if (text[offset] == '"') end = std::min(text.find_first_of("\"\n", offset + 1), text.size() - 1) + 1;
  std::string_view word = text.substr(offset, std::min<std::size_t>(end - offset, 40));
  if (const std::size_t last = word.find_last_not_of("\r\n"); last != std::string_view::npos)
    word = word.substr(0, last + 1);
  return text[offset] == '"' ? std::string(word) : fmt::format("'{}'", word);
}

/// What the parser expected, in words for people.
std::string allowed_by(const ParserStop& stop) {
  const auto has = [&](std::string_view words) { return stop.reason.find(words) != std::string::npos; };
  if (has("overflow")) return "a number of at most 1.79e308";
  if (has("missing closing quote") || has("control character"))
    return "text that ends with a double quote on the same line (\\n and \\t stand for breaks and tabs)";
  if (has("forbidden character after backslash"))
    return "one of \" \\ / b f n r t u behind a backslash (a backslash itself: two of them)";
  if (has("must be followed by")) return "\\u and four hexadecimal digits; beyond U+FFFF a surrogate pair";
  if (has("UTF-8")) return "text in UTF-8";
  if (has("missing '*/'") || has("invalid comment"))
    return "a comment: /* … */, or // to the end of the line";
  if (has("; expected string literal")) return "a key in double quotes";
  if (has("; expected ':'")) return "a colon between a key and its value";
  if (has("; expected '}'")) return "a comma, or '}'";
  if (has("; expected ']'")) return "a comma, or ']'";
  if (has("; expected end of input")) return "nothing behind the outermost value";
  return kAnyValue;
}

bool begins_a_value(char c) {
  return (c >= '0' && c <= '9') || std::string_view("\"{[-tfn").find(c) != std::string_view::npos;
}

/// A comma that is missing in front of the next token, or stands where none may.
std::optional<JsonFault> wrong_comma(const ParserStop& stop) {
  if (!stop.open || stop.token >= stop.text.size()) return std::nullopt;
  const char next = stop.text[stop.token];
  const auto fault = [](std::size_t at, std::string message) {
    return JsonFault{static_cast<std::uint32_t>(at), "", "", "", std::move(message)};
  };
  if (stop.commas.empty()) {
    const bool is_apart = stop.token > stop.gap || next == '"' || next == '{' || next == '[';
    if (!stop.follows_value || !is_apart || !begins_a_value(next) || stop.last_read < stop.token)
      return std::nullopt;
    const int line_before = line_and_column(stop.text, stop.gap).line;
    const bool is_on_a_later_line = line_before < line_and_column(stop.text, stop.token).line;
    return fault(stop.token,
                 fmt::format("a comma is missing before {}{}", show_at(stop.text, stop.token),
                             is_on_a_later_line ? fmt::format(", at the end of line {}", line_before) : ""));
  }
  const bool begins_list = stop.gap > 0 && (stop.text[stop.gap - 1] == '{' || stop.text[stop.gap - 1] == '[');
  if (!stop.follows_value && !begins_list) return std::nullopt;  // a key without its value
  if (!stop.follows_value) return fault(stop.commas.front(), "a comma too many: nothing stands before it");
  if (stop.commas.size() > 1) return fault(stop.commas[1], "a comma too many: nothing stands before it");
  if (next == '}' || next == ']')
    return fault(stop.commas.front(), fmt::format("a comma too many: only '{}' follows it", next));
  return std::nullopt;
}

}  // namespace

JsonFault fault_of(const ParserStop& stop) {
  if (auto comma = wrong_comma(stop)) return *std::move(comma);
  // What it could not use begins where no more than blanks and punctuation follow the last token, or is
  // punctuation.
  const std::size_t offset = std::min(stop.token, stop.last_read);
  if (stop.open && stop.token >= stop.text.size()) {
    return {static_cast<std::uint32_t>(offset), "", "", "",
            fmt::format("the text ends, but the {} that begins on line {} is not closed with '{}'",
                        stop.open->is_list ? "list" : "object",
                        line_and_column(stop.text, stop.open->offset).line, stop.open->is_list ? ']' : '}')};
  }
  return {static_cast<std::uint32_t>(offset), "", show_at(stop.text, offset), allowed_by(stop)};
}

std::string message_of(const JsonFault& fault) {
  if (!fault.sentence.empty()) return fault.sentence;
  return fmt::format("found {}, allowed: {}", fault.found, fault.allowed);
}

}  // namespace polynya::io
