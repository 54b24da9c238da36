#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "io/text/source_text.hpp"

namespace polynya::io {

struct JsonMember;

/// A JSON value that remembers where in its text it stood. Objects keep their order.
struct JsonValue {
  using Array = std::vector<JsonValue>;
  using Object = std::vector<JsonMember>;
  /// In the order of Data and of name_of().
  enum class Kind { kNull, kBoolean, kNumber, kText, kArray, kObject };

  using Data = std::variant<std::nullptr_t, bool, double, std::string, Array, Object>;

  Data data;
  std::uint32_t offset = 0;  ///< of the value's first byte in its text

  Kind kind() const { return static_cast<Kind>(data.index()); }
  bool is(Kind other) const { return kind() == other; }
  bool is_null() const { return is(Kind::kNull); }

  bool boolean() const { return std::get<bool>(data); }
  double number() const { return std::get<double>(data); }
  const std::string& text() const { return std::get<std::string>(data); }
  const Array& items() const { return std::get<Array>(data); }
  Array& items() { return std::get<Array>(data); }
  const Object& members() const { return std::get<Object>(data); }
  Object& members() { return std::get<Object>(data); }

  /// The member of that key, or null where this is no object or has none.
  const JsonValue* find(std::string_view key) const;
  /// The same where it is of that kind.
  const JsonValue* find(std::string_view key, Kind kind) const {
    const JsonValue* found = find(key);
    return found && found->is(kind) ? found : nullptr;
  }
  /// Whether it has that text as a member.
  bool has(std::string_view key, std::string_view text) const {
    const JsonValue* found = find(key, Kind::kText);
    return found && found->text() == text;
  }
  /// Gives a member of an object that value, and makes it where there is none; what is no object stays.
  void set(std::string_view key, Data value);
  JsonValue* find(std::string_view key) { return const_cast<JsonValue*>(std::as_const(*this).find(key)); }
};

struct JsonMember {
  std::string key;
  std::uint32_t key_offset = 0;  ///< of the key's opening quote
  JsonValue value;
};

inline const JsonValue* JsonValue::find(std::string_view key) const {
  if (!is(Kind::kObject)) return nullptr;
  for (const JsonMember& member : members()) {
    if (member.key == key) return &member.value;
  }
  return nullptr;
}

inline void JsonValue::set(std::string_view key, Data value) {
  if (!is(Kind::kObject)) return;
  JsonValue* member = find(key);
  if (!member) member = &members().emplace_back(JsonMember{std::string(key), offset, {nullptr, offset}}).value;
  member->data = std::move(value);
}

/// Calls use(offset) for the places of a value, of all within it and of their keys.
template <class Use>
void for_offsets(JsonValue& value, Use use) {
  use(value.offset);
  if (value.is(JsonValue::Kind::kArray)) {
    for (JsonValue& item : value.items()) for_offsets(item, use);
  } else if (value.is(JsonValue::Kind::kObject)) {
    for (JsonMember& member : value.members()) {
      use(member.key_offset);
      for_offsets(member.value, use);
    }
  }
}

/// Offset of the value at a path, "hull.length_m" or "rows[2].t_s", or of the nearest value on the way to it.
std::uint32_t nearest_offset(const JsonValue& root, std::string_view path);

/// "a number", "text", … for messages.
std::string_view name_of(JsonValue::Kind kind);

/// The member of that key, of that kind where one is given; throws ReadError where there is none.
const JsonValue& json_member(const JsonValue& value, std::string_view key);
const JsonValue& json_member(const JsonValue& value, std::string_view key, JsonValue::Kind kind);

inline constexpr std::size_t kDeepestNesting = 64;
inline constexpr std::size_t kLongestText = std::size_t{256} << 20;  ///< [bytes]

/// Something wrong in a JSON text, before its meaning is read. It has the path of a key that stands twice; none else.
struct JsonFault : Problem {
  std::uint32_t offset = 0;  ///< byte in the text
};

struct JsonDocument {
  JsonValue root;
  std::vector<JsonFault> faults;  ///< empty where the text is sound
};

/// Reads JSON with // and /* */ comments. A syntax error ends the reading (the root is then what was read so
/// far); keys that stand twice are faults and the first one counts. Nesting and length are bounded.
JsonDocument parse_json(std::string_view text);

/// The first fault of a document, "12:5: found '=', allowed: a colon", by its text; it has one.
std::string first_fault(const JsonDocument& document, std::string_view text);

/// JSON in which also NaN, Infinity and numbers beyond the doubles stand, as Python and others write them:
/// each of them becomes an empty text, which no number is. The error is "line:column: words".
Result<JsonValue> parse_lenient_json(std::string_view text);

/// The value that begins at an offset of a text that parse_lenient_json accepts, as it is written there but
/// without blanks and comments; what is not finite becomes null.
std::string compact_json(std::string_view text, std::size_t offset);

}  // namespace polynya::io
