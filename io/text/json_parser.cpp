#include "io/text/json_parser.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <unordered_set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace polynya::io {
namespace {

constexpr auto kAnyValue = "an object, a list, text in double quotes, a number, true, false or null";
constexpr std::string_view kOfWords = "+-._0123456789abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ";

/// A bracket, a sign, a text with its quotes, or a word; empty at the end of the text. A text that is not closed on its
/// line has no second quote.
struct Token {
  std::size_t begin = 0;  ///< position in the text [bytes]
  std::string_view text = {};
  bool is_closed = true;  ///< false for a text without a second quote

  std::size_t end() const { return begin + text.size(); }
  bool is(char sign) const { return text.size() == 1 && text[0] == sign; }
  bool is_text() const { return text.starts_with('"'); }
};

/// Divides a text into tokens and skips blanks and comments between them.
class Lexer {
 public:
  explicit Lexer(std::string_view text, std::size_t begin = 0) : text_(text), at_(begin) {
    if (begin == 0 && text.starts_with("\xEF\xBB\xBF")) at_ = 3;
  }

  Token next() {
    skip();
    const std::size_t begin = at_;
    if (begin == text_.size()) return {begin, {}};
    bool is_closed = true;
    if (text_[begin] == '"')
      is_closed = pass_text();
    else if (kOfWords.find(text_[begin]) != std::string_view::npos)
      at_ = std::min(text_.find_first_not_of(kOfWords, begin), text_.size());
    else
      do ++at_;
      while (at_ < text_.size() && (static_cast<unsigned char>(text_[at_]) & 0xC0) == 0x80);
    return {begin, text_.substr(begin, at_ - begin), is_closed};
  }

 private:
  void skip() {
    while (at_ < text_.size()) {
      const std::string_view rest = text_.substr(at_, 2);
      if (rest == "//")
        at_ = std::min(text_.find('\n', at_), text_.size());
      else if (const auto end = rest == "/*" ? text_.find("*/", at_ + 2) : std::string_view::npos;
               end != std::string_view::npos)
        at_ = end + 2;
      else if (std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos)
        ++at_;
      else
        return;
    }
  }
  /// Moves behind a quoted text. Returns false if no quote closes it on its line.
  bool pass_text() {
    for (++at_; at_ < text_.size() && static_cast<unsigned char>(text_[at_]) >= 0x20; ++at_) {
      if (text_[at_] == '"') return ++at_, true;
      if (text_[at_] == '\\' && at_ + 1 < text_.size()) ++at_;
    }
    return false;
  }

  std::string_view text_;
  std::size_t at_;
};

bool is_digit(char c) {
  return c >= '0' && c <= '9';
}

/// Returns the number that a word of JSON's grammar represents; infinite if it is too large for a double.
std::optional<double> number_in(std::string_view word) {
  const std::string_view digits = word.substr(word.starts_with('-') ? 1 : 0);
  if (digits.empty() || !is_digit(digits[0]) || (digits.size() > 1 && digits[0] == '0' && is_digit(digits[1])))
    return {};
  const std::size_t dot = digits.find('.');
  if (dot != std::string_view::npos && !(dot + 1 < digits.size() && is_digit(digits[dot + 1]))) return {};
  double value = 0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size()) return {};
  // The number is too small or too large for a double: strtod returns 0 or infinity.
  return error == std::errc() ? value : std::strtod(std::string(word).c_str(), nullptr);
}

/// Returns true for NaN, Infinity and numbers beyond the range of a double.
bool is_not_finite(std::string_view word) {
  if (word.size() < 3 || kOfWords.find(word[0]) == std::string_view::npos) return false;
  const std::string copy(word);
  char* end = nullptr;
  return !std::isfinite(std::strtod(copy.c_str(), &end)) && end == copy.c_str() + copy.size();
}

/// Returns the token as messages show it, on one line.
std::string shown(const Token& token) {
  if (token.text.empty()) return "the end of the text";
  if (static_cast<unsigned char>(token.text[0]) < 0x20) return "a control character";
  const std::string_view word = token.text.substr(0, 40);
  return token.is_text() ? std::string(word) : fmt::format("'{}'", word);
}

/// Keys of the object that is being read. They are kept to find a key that occurs twice.
class Keys {
 public:
  /// Returns false if the object, whose members so far are given, has the key already. Few keys are compared one by
  /// one; many are hashed, so that the time grows in proportion to their number.
  bool add(const JsonValue::Object& members, const std::string& key) {
    constexpr std::size_t kFew = 16;
    if (members.size() < kFew) return std::ranges::find(members, key, &JsonMember::key) == members.end();
    if (hashed_.empty())
      for (const JsonMember& member : members) hashed_.insert(member.key);
    return hashed_.insert(key).second;
  }

 private:
  std::unordered_set<std::string> hashed_;
};

class Parser {
 public:
  Parser(std::string_view text, bool is_lenient, JsonDocument& document)
      : text_(text), is_lenient_(is_lenient), document_(document), lexer_(text) {}

  void parse() {
    try {
      advance();
      value(document_.root);
      if (!token_.text.empty()) refuse("nothing behind the outermost value");
    } catch (JsonFault& fault) {
      document_.faults.push_back(std::move(fault));
    }
  }

 private:
  void advance() {
    last_end_ = token_.end();
    token_ = lexer_.next();
  }
  [[noreturn]] static void stop(std::size_t offset, std::string sentence) {
    throw JsonFault{{.sentence = std::move(sentence)}, static_cast<std::uint32_t>(offset)};
  }
  int line_of(std::size_t offset) const { return line_and_column(text_, offset).line; }

  /// Reports that the current token is not allowed here, and ends the reading.
  [[noreturn]] void refuse(std::string_view allowed) {
    if (token_.text.empty() && !open_.empty()) {
      const bool is_list = open_.back().is('[');
      stop(token_.begin, fmt::format("the text ends, but the {} that begins on line {} is not closed with '{}'",
                                     is_list ? "list" : "object", line_of(open_.back().begin), is_list ? ']' : '}'));
    }
    if (token_.is('/')) allowed = "a comment: /* … */, or // to the end of the line";
    throw JsonFault{{.found = shown(token_), .allowed = std::string(allowed)},
                    static_cast<std::uint32_t>(token_.begin)};
  }

  void value(JsonValue& slot) {
    slot.offset = static_cast<std::uint32_t>(token_.begin);
    if (token_.is('{')) return object(slot.data.emplace<JsonValue::Object>());
    if (token_.is('[')) {
      auto& items = slot.data.emplace<JsonValue::Array>();
      return list(']', [&] { value(items.emplace_back()); });
    }
    if (token_.is_text())
      slot.data = text();
    else if (token_.text == "true" || token_.text == "false")
      slot.data = token_.text == "true";
    else if (const auto number = number_in(token_.text); number && std::isfinite(*number))
      slot.data = *number;
    else if (is_lenient_ && is_not_finite(token_.text))
      slot.data = std::string();
    else if (token_.text != "null")
      refuse(number ? "a number of at most 1.79e308" : kAnyValue);
    advance();
  }

  void object(JsonValue::Object& members) {
    Keys keys;
    list('}', [&] {
      if (!token_.is_text()) refuse("a key in double quotes");
      std::string key = text();
      const auto offset = static_cast<std::uint32_t>(token_.begin);
      advance();
      if (!token_.is(':')) refuse("a colon between a key and its value");
      advance();
      JsonValue second;
      const bool is_second = !keys.add(members, key);
      if (is_second)
        document_.faults.push_back(
            {{.path = key, .found = fmt::format("\"{}\" a second time", key), .allowed = "each key once"}, offset});
      value(is_second ? second : members.emplace_back(JsonMember{std::move(key), offset, {}}).value);
    });
  }

  /// Reads items up to the bracket `close`, with commas between them.
  template <class Item>
  void list(char close, Item item) {
    if (open_.size() >= kDeepestNesting)
      throw JsonFault{{.found = "deeper nesting", .allowed = fmt::format("at most {} levels", kDeepestNesting)},
                      static_cast<std::uint32_t>(token_.begin)};
    constexpr auto kNothingBefore = "a comma too many: nothing stands before it";
    open_.push_back(token_);
    advance();
    if (token_.is(',')) stop(token_.begin, kNothingBefore);
    while (!token_.is(close)) {
      item();
      if (token_.is(close)) break;
      const Token comma = token_;
      if (!comma.is(',')) refuse_without_comma(close);
      advance();
      if (token_.is(',')) stop(token_.begin, kNothingBefore);
      if (token_.is('}') || token_.is(']'))
        stop(comma.begin, fmt::format("a comma too many: only '{}' follows it", token_.text));
      if (token_.text.empty()) refuse(kAnyValue);
    }
    open_.pop_back();
    advance();
  }

  [[noreturn]] void refuse_without_comma(char close) {
    const bool begins_value = token_.is('{') || token_.is('[') || token_.is_text() || number_in(token_.text) ||
                              token_.text == "true" || token_.text == "false" || token_.text == "null";
    if (!begins_value) refuse(fmt::format("a comma, or '{}'", close));
    const int line_before = line_of(last_end_);
    stop(token_.begin,
         fmt::format("a comma is missing before {}{}", shown(token_),
                     line_before < line_of(token_.begin) ? fmt::format(", at the end of line {}", line_before) : ""));
  }

  /// Returns the current token as text. The library decodes texts with escapes.
  std::string text() {
    const std::string_view quoted = token_.text;
    if (!token_.is_closed)
      refuse("text that ends with a double quote on the same line (\\n and \\t stand for breaks and tabs)");
    const auto is_plain = [](char c) { return c != '\\' && static_cast<unsigned char>(c) < 0x80; };
    if (std::ranges::all_of(quoted, is_plain)) return std::string(quoted.substr(1, quoted.size() - 2));
    const auto read = nlohmann::json::parse(quoted, nullptr, false);
    if (!read.is_string())
      refuse("text in UTF-8, with one of \" \\ / b f n r t u behind a backslash (a backslash itself: two of them)");
    return read.get<std::string>();
  }

  std::string_view text_;
  bool is_lenient_;
  JsonDocument& document_;
  Lexer lexer_;
  Token token_;
  std::size_t last_end_ = 0;  ///< end of the previous token
  std::vector<Token> open_;   ///< brackets that are still open
};

JsonDocument parsed(std::string_view text, bool is_lenient) {
  JsonDocument document;
  if (text.size() > kLongestText)
    document.faults.push_back(
        {{.found = fmt::format("{} bytes", text.size()), .allowed = fmt::format("at most {} bytes", kLongestText)}});
  else
    Parser(text, is_lenient, document).parse();
  return document;
}

}  // namespace

std::uint32_t nearest_offset(const JsonValue& root, std::string_view path) {
  const JsonValue* value = &root;
  for (std::size_t begin = 0; begin < path.size();) {
    const std::size_t end = std::min(path.find_first_of(".[", begin + 1), path.size());
    const std::string_view step = path.substr(begin, end - begin);
    const JsonValue* next = nullptr;
    if (!step.starts_with('[')) {
      next = value->find(step.substr(step.starts_with('.') ? 1 : 0));
    } else if (value->is(JsonValue::Kind::kArray)) {
      std::size_t index = 0;
      std::from_chars(step.data() + 1, step.data() + step.size(), index);
      if (index < value->items().size()) next = &value->items()[index];
    }
    if (!next) break;
    value = next;
    begin = end;
  }
  return value->offset;
}

std::string_view name_of(JsonValue::Kind kind) {
  constexpr std::string_view kNames[]{"null", "true or false", "a number", "text", "a list", "an object"};
  return kNames[static_cast<std::size_t>(kind)];
}

const JsonValue& json_member(const JsonValue& value, std::string_view key) {
  const JsonValue* found = value.find(key);
  if (!found) throw ReadError(fmt::format("\"{}\" is missing", key));
  return *found;
}

const JsonValue& json_member(const JsonValue& value, std::string_view key, JsonValue::Kind kind) {
  const JsonValue* found = value.find(key, kind);
  if (!found) throw ReadError(fmt::format("\"{}\" is not {}", key, name_of(kind)));
  return *found;
}

JsonDocument parse_json(std::string_view text) {
  return parsed(text, false);
}

std::string first_fault(const JsonDocument& document, std::string_view text) {
  const JsonFault& fault = document.faults.front();
  const LineAndColumn place = line_and_column(text, fault.offset);
  return fmt::format("{}:{}: {}", place.line, place.column, message_of(fault));
}

Result<JsonValue> parse_lenient_json(std::string_view text) {
  JsonDocument document = parsed(text, true);
  if (!document.faults.empty()) return fail(first_fault(document, text));
  return std::move(document.root);
}

std::string compact_json(std::string_view text, std::size_t offset) {
  std::string compact;
  Lexer lexer(text, offset);
  int depth = 0;
  do {
    const Token token = lexer.next();
    if (token.text.empty()) break;
    if (token.is('[') || token.is('{')) ++depth;
    if (token.is(']') || token.is('}')) --depth;
    compact += is_not_finite(token.text) ? "null" : token.text;
  } while (depth > 0);
  return compact;
}

}  // namespace polynya::io
