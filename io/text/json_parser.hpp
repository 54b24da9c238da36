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

/// A JSON value that stores where it stood in its text, so that messages can name the place. Objects keep the order of
/// their members. A new value is null.
struct JsonValue {
  using Array = std::vector<JsonValue>;
  using Object = std::vector<JsonMember>;
  /// Kinds of values, in the order of Data and of name_of().
  enum class Kind { kNull, kBoolean, kNumber, kText, kArray, kObject };

  using Data = std::variant<std::nullptr_t, bool, double, std::string, Array, Object>;

  Data data;
  std::uint32_t offset = 0;  ///< position of the value in its text [bytes]

  Kind kind() const { return static_cast<Kind>(data.index()); }
  bool is(Kind other) const { return kind() == other; }
  bool is_null() const { return is(Kind::kNull); }

  /// Return the value of that kind. The caller has checked the kind; a value of another kind throws
  /// std::bad_variant_access.
  bool boolean() const { return std::get<bool>(data); }
  double number() const { return std::get<double>(data); }
  const std::string& text() const { return std::get<std::string>(data); }
  const Array& items() const { return std::get<Array>(data); }
  Array& items() { return std::get<Array>(data); }
  const Object& members() const { return std::get<Object>(data); }
  Object& members() { return std::get<Object>(data); }

  /// Returns the member of that key, or null if this is not an object or has no such member.
  const JsonValue* find(std::string_view key) const;
  /// Returns the member of that key if it is of that kind, or else null.
  const JsonValue* find(std::string_view key, Kind kind) const {
    const JsonValue* found = find(key);
    return found && found->is(kind) ? found : nullptr;
  }
  /// Returns true if this is an object that has this member and the member is this text.
  bool has(std::string_view key, std::string_view text) const {
    const JsonValue* found = find(key, Kind::kText);
    return found && found->text() == text;
  }
  /// Sets a member of an object, and adds it if the object has none. A member that is added has the position of the
  /// object. Does nothing if this is not an object.
  void set(std::string_view key, Data value);
  /// Does the same as the other find(), to change the member.
  JsonValue* find(std::string_view key) { return const_cast<JsonValue*>(std::as_const(*this).find(key)); }
};

/// A member of an object.
struct JsonMember {
  std::string key;
  std::uint32_t key_offset = 0;  ///< position of the opening quote of the key in the text [bytes]
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

/// Calls use(offset) for the position of a value and of everything within it, and for the positions of keys. `use` may
/// change them, for example if the value becomes part of another text. A value is visited before its items.
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

/// Returns the position [bytes] of the value at a path such as "hull.length_m" or "rows[2].t_s", or of the last value
/// on the way that exists, as the place of a message about a value that may be missing. With an empty path it is that
/// of the root.
std::uint32_t nearest_offset(const JsonValue& root, std::string_view path);

/// Returns the name of a kind in messages: "a number", "text" and so on.
std::string_view name_of(JsonValue::Kind kind);

/// Return the member of that key (and of that kind). Throw ReadError with the key if there is none, or if it is of
/// another kind. A reference into `value` is returned.
const JsonValue& json_member(const JsonValue& value, std::string_view key);
const JsonValue& json_member(const JsonValue& value, std::string_view key, JsonValue::Kind kind);

/// Deepest nesting of lists and objects that is read. It bounds the stack of the recursive reader. A smaller value
/// would refuse foreign files with deep properties, a much larger one could let a wrong file crash the program.
inline constexpr std::size_t kDeepestNesting = 64;
/// Longest text that is read [bytes]. It bounds the memory that a wrong file can take, and keeps positions within 32
/// bits. No reader of JSON can accept longer texts, whatever its own limit is.
inline constexpr std::size_t kLongestText = std::size_t{512} << 20;

/// A fault of a JSON text that is found before its meaning is read. Only a key that occurs twice has a path (the key);
/// after any other fault the rest of the text was not read.
struct JsonFault : Problem {
  std::uint32_t offset = 0;  ///< position in the text [bytes]
};

/// Result of parse_json().
struct JsonDocument {
  JsonValue root;                 ///< null if nothing could be read
  std::vector<JsonFault> faults;  ///< in the order of the text; empty if it has none
};

/// Reads JSON with // and /* */ comments. A syntax error ends the reading; the root is then the part that was read. A
/// key that occurs twice is a fault, its first value counts, and the reading goes on. Nesting and length are limited
/// (kDeepestNesting, kLongestText); deeper nesting ends the reading, and of a longer text nothing is read. NaN,
/// Infinity and numbers beyond the range of a double are faults. A byte order mark at the start is skipped.
JsonDocument parse_json(std::string_view text);

/// Returns the first fault of a document in words with line and column, "12:5: found '=', allowed: a colon". `text` is
/// the text of the document, which must have a fault.
std::string first_fault(const JsonDocument& document, std::string_view text);

/// Reads JSON in which NaN, Infinity and numbers beyond the range of a double may also occur, as Python and other
/// programs write them. Each of these becomes an empty text, which cannot be mistaken for a number. The error is
/// "line:column: words" of the first fault. A key that occurs twice is an error here too.
Result<JsonValue> parse_lenient_json(std::string_view text);

/// Returns the value that begins at `offset` [bytes] of a text that parse_lenient_json accepts, as written but without
/// blanks and comments. So numbers keep their digits in files that Polynya writes. Numbers that are not finite become
/// null. The text is not checked again.
std::string compact_json(std::string_view text, std::size_t offset);

}  // namespace polynya::io
