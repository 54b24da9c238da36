#include "io/text/json_parser.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

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

/// Follows the parser's events through the text. The parser gives no positions, but between two events only
/// blanks, comments, commas and colons can stand, so each event's own first byte can be found again.
class PlaceFinder {
 public:
  explicit PlaceFinder(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) end_ = 3;
  }

  std::uint32_t start_of_token() {
    while (end_ < text_.size()) {
      const char c = text_[end_];
      if (c == ' ' || c == '\t' || c == '\r' || c == '\n' || c == ',' || c == ':') {
        if (c == ',') commas_.push_back(end_);
        ++end_;
      } else if (const std::size_t behind = end_of_comment(text_, end_); behind > end_) {
        end_ = behind;
      } else {
        break;
      }
    }
    return static_cast<std::uint32_t>(end_);
  }
  void pass(std::size_t length) { begin_gap(end_ + length); }
  void pass_number() {
    const auto is_of_number = [](char c) {
      return (c >= '0' && c <= '9') || c == '.' || c == '-' || c == '+' || c == 'e' || c == 'E';
    };
    while (end_ < text_.size() && is_of_number(text_[end_])) ++end_;
    begin_gap(end_);
  }
  void pass_text() { begin_gap(end_of_text(text_, end_)); }
  /// Just behind the last token.
  std::size_t gap() const { return gap_; }
  /// Where commas stand between the last token and what start_of_token() found.
  const std::vector<std::size_t>& commas() const { return commas_; }

 private:
  void begin_gap(std::size_t at) {
    end_ = gap_ = at;
    commas_.clear();
  }

  std::string_view text_;
  std::size_t end_ = 0;  // as far as the text has been followed
  std::size_t gap_ = 0;
  std::vector<std::size_t> commas_;
};

class TreeBuilder : public nlohmann::json_sax<nlohmann::json> {
 public:
  TreeBuilder(std::string_view text, JsonDocument& document) : places_(text), text_(text), document_(document) {}

  bool null() override {
    place(nullptr);
    places_.pass(4);
    return true;
  }
  bool boolean(bool value) override {
    place(value);
    places_.pass(value ? 4 : 5);
    return true;
  }
  bool number_integer(number_integer_t value) override { return any_number(static_cast<double>(value)); }
  bool number_unsigned(number_unsigned_t value) override { return any_number(static_cast<double>(value)); }
  bool number_float(number_float_t value, const string_t&) override { return any_number(value); }
  bool string(string_t& value) override {
    place(std::move(value));
    places_.pass_text();
    return true;
  }
  bool binary(binary_t&) override { return false; }

  bool start_object(std::size_t) override { return open(JsonValue::Object{}); }
  bool start_array(std::size_t) override { return open(JsonValue::Array{}); }
  bool key(string_t& key) override {
    const std::uint32_t offset = places_.start_of_token();
    places_.pass_text();
    follows_value_ = false;
    open_.back()->members().push_back({std::move(key), offset, {}});
    return true;
  }
  bool end_object() override {
    drop_repeated_keys(*open_.back());
    return close();
  }
  bool end_array() override { return close(); }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) override {
    const std::size_t gap = places_.gap();
    const std::size_t token = places_.start_of_token();
    ParserStop stop{.text = text_,
                    .reason = error.what(),
                    .token = token,
                    .last_read = position > 0 ? position - 1 : 0,
                    .gap = gap,
                    .commas = places_.commas(),
                    .follows_value = follows_value_};
    if (!open_.empty()) stop.open = {open_.back()->offset, open_.back()->is(JsonValue::Kind::kArray)};
    document_.faults.push_back(fault_of(stop));
    return false;
  }

 private:
  template <class Value>
  JsonValue& place(Value&& value) {
    JsonValue* slot = &document_.root;
    if (!open_.empty()) {
      JsonValue& parent = *open_.back();
      slot = parent.is(JsonValue::Kind::kArray) ? &parent.items().emplace_back() : &parent.members().back().value;
    }
    slot->data = std::forward<Value>(value);
    slot->offset = places_.start_of_token();
    follows_value_ = true;
    return *slot;
  }
  bool any_number(double value) {
    place(value);
    places_.pass_number();
    return true;
  }
  template <class Container>
  bool open(Container container) {
    JsonValue& slot = place(std::move(container));
    places_.pass(1);
    follows_value_ = false;
    if (open_.size() >= kDeepestNesting) {
      document_.faults.push_back(
          {slot.offset, "", "deeper nesting", fmt::format("at most {} levels", kDeepestNesting)});
      return false;
    }
    open_.push_back(&slot);  // stays put: its parent grows only after it is closed
    return true;
  }
  bool close() {
    places_.start_of_token();
    places_.pass(1);
    follows_value_ = true;
    open_.pop_back();
    return true;
  }
  /// Nearly all objects are small and have none: these take no memory.
  static bool may_repeat_keys(const JsonValue::Object& members) {
    constexpr std::size_t kFew = 32;
    if (members.size() > kFew) return true;
    for (std::size_t i = 1; i < members.size(); ++i) {
      for (std::size_t k = 0; k < i; ++k)
        if (members[i].key == members[k].key) return true;
    }
    return false;
  }
  void drop_repeated_keys(JsonValue& object) {
    auto& members = object.members();
    if (!may_repeat_keys(members)) return;
    std::vector<const JsonMember*> sorted;
    for (const JsonMember& member : members) sorted.push_back(&member);
    std::ranges::stable_sort(sorted, {}, [](const JsonMember* m) { return std::string_view(m->key); });
    std::vector<std::uint32_t> repeated;
    for (std::size_t i = 1; i < sorted.size(); ++i) {
      if (sorted[i]->key != sorted[i - 1]->key) continue;
      repeated.push_back(sorted[i]->key_offset);
      document_.faults.push_back({sorted[i]->key_offset, sorted[i]->key,
                                  fmt::format("\"{}\" a second time", sorted[i]->key), "each key once"});
    }
    if (repeated.empty()) return;
    std::erase_if(members,
                  [&](const JsonMember& m) { return std::ranges::find(repeated, m.key_offset) != repeated.end(); });
  }

  PlaceFinder places_;
  std::string_view text_;
  JsonDocument& document_;
  std::vector<JsonValue*> open_;
  bool follows_value_ = false;  // the last token completed a value
};

}  // namespace

std::uint32_t nearest_offset(const JsonValue& root, std::string_view path) {
  const JsonValue* value = &root;
  while (!path.empty()) {
    const auto dot = std::min(path.find('.'), path.size());
    const JsonValue* next = value->find(path.substr(0, dot));
    if (!next) break;
    value = next;
    path.remove_prefix(std::min(dot + 1, path.size()));
  }
  return value->offset;
}

std::string_view name_of(JsonValue::Kind kind) {
  constexpr std::string_view kNames[]{"null", "true or false", "a number", "text", "a list", "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

JsonDocument parse_json(std::string_view text) {
  JsonDocument document;
  if (text.size() > kLongestText) {
    document.faults.push_back(
        {0, "", fmt::format("{} bytes", text.size()), fmt::format("at most {} bytes", kLongestText)});
    return document;
  }
  if (const auto nul = text.find('\0'); nul != std::string_view::npos) {
    document.faults.push_back({static_cast<std::uint32_t>(nul), "", "a zero byte", "text in UTF-8"});
    return document;
  }
  TreeBuilder builder(text, document);
  nlohmann::json::sax_parse(text.begin(), text.end(), &builder, nlohmann::json::input_format_t::json, true, true);
  return document;
}

namespace {

constexpr auto kAnyValue = "an object, a list, text in double quotes, a number, true, false or null";

/// The word or sign at an offset, on one line.
std::string show_at(std::string_view text, std::size_t offset) {
  if (offset >= text.size()) return "the end of the text";
  if (std::string_view("[]{},:").find(text[offset]) != std::string_view::npos) return fmt::format("'{}'", text[offset]);
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
  if (has("missing '*/'") || has("invalid comment")) return "a comment: /* … */, or // to the end of the line";
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
    if (!stop.follows_value || !is_apart || !begins_a_value(next) || stop.last_read < stop.token) return std::nullopt;
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
                        stop.open->is_list ? "list" : "object", line_and_column(stop.text, stop.open->offset).line,
                        stop.open->is_list ? ']' : '}')};
  }
  return {static_cast<std::uint32_t>(offset), "", show_at(stop.text, offset), allowed_by(stop)};
}

std::string message_of(const JsonFault& fault) {
  if (!fault.sentence.empty()) return fault.sentence;
  return fmt::format("found {}, allowed: {}", fault.found, fault.allowed);
}

namespace {

bool is_not_finite(const std::string& token) {
  const char* const start = token.c_str();
  char* end = nullptr;
  const double value = std::strtod(start, &end);  // reads NaN and Infinity too
  return end == start + token.size() && !std::isfinite(value);
}

constexpr std::string_view kOfTokens = "+-.0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

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
        std::fill(text.begin() + static_cast<std::ptrdiff_t>(at), text.begin() + static_cast<std::ptrdiff_t>(end), ' ');
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
