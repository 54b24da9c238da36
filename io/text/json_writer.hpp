#pragma once

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {

/// Appends a number as the shortest text that reads back to the same double, independent of the locale. −0 is written
/// as 0, whole numbers without a point, and numbers that are not finite as null.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);

/// Appends UTF-8 text as a JSON string with its quotes. Quotes, backslashes and control characters are escaped; whether
/// the text is valid UTF-8 is not checked.
void append_text(std::string& text, std::string_view value);

/// Returns a text with &, <, > and both quotes escaped, for the contents and the attributes of XML and SVG elements.
std::string escaped(std::string_view text);

/// Returns bytes as base64 text (RFC 4648, with padding, without line breaks).
std::string to_base64(std::string_view bytes);

/// Appends JSON to a string that the caller owns, so that the string's memory can be used again. It writes the commas,
/// but does not check that brackets and keys fit together. Functions that write return the writer, so that calls can be
/// chained.
///
///   JsonWriter json(line);
///   json.open('{').key("t_s").value(0.5).key("children").open('[').value(3).close(']').close('}');
class JsonWriter {
 public:
  /// All on one line (except after start_line()), or each item and member on a line of its own, indented by two blanks
  /// per level. A point, a vector and a ring are one item.
  enum class Layout { kLine, kIndented };
  /// `text` must exist longer than this object.
  explicit JsonWriter(std::string& text, Layout layout = Layout::kLine) : text_(text), layout_(layout) {}

  /// Begins an object with '{' or a list with '['.
  JsonWriter& open(char bracket);
  /// Ends it with '}' or ']'.
  JsonWriter& close(char bracket);
  /// Writes the key of a member of the open object. Its value must follow.
  JsonWriter& key(std::string_view name);
  // value() writes an item of the open list, or the value of the last key. Points and vectors are written as [x, y],
  // and a ring as a list of its points, without closing it. Integers must fit into 64 bits with a sign.
  JsonWriter& value(double number) {
    return put([=](std::string& text) { append_number(text, number); });
  }
  template <std::integral Number>
  JsonWriter& value(Number number) {
    return put([=](std::string& text) { append_number(text, static_cast<std::int64_t>(number)); });
  }
  JsonWriter& value(bool truth) { return json(truth ? "true" : "false"); }
  JsonWriter& value(std::nullptr_t) { return json("null"); }
  JsonWriter& value(std::string_view words) {
    return put([=](std::string& text) { append_text(text, words); });
  }
  JsonWriter& value(const char* words) { return value(std::string_view(words)); }
  JsonWriter& value(geometry::Point point);
  JsonWriter& value(geometry::Vector vector) { return value(geometry::Point{vector.x, vector.y}); }
  JsonWriter& value(const geometry::Ring& ring);
  /// Writes the coordinates of a GeoJSON Polygon: all rings, each closed by its first point.
  JsonWriter& value(const geometry::Polygon& polygon);
  /// Writes the value, or null if there is none.
  template <class Value>
  JsonWriter& value(const std::optional<Value>& known) {
    return known ? value(*known) : null();
  }
  JsonWriter& null() { return value(nullptr); }
  /// Writes a list of values.
  template <class Values>
  JsonWriter& list(const Values& values) {
    open('[');
    for (const auto& each : values) value(each);
    return close(']');
  }
  /// Writes an object; `write` writes its members.
  template <class Write>
  JsonWriter& object(Write write) {
    open('{');
    write();
    return close('}');
  }
  /// Writes a list of objects; `write(item)` writes the members of each. `has_lines`: each object starts on a new line.
  template <class Items, class Write>
  JsonWriter& objects(const Items& items, Write write, bool has_lines = false) {
    open('[');
    for (const auto& item : items) {
      if (has_lines) start_line();
      object([&] { write(item); });
    }
    return close(']');
  }
  /// Writes the same list with each object on a line of its own.
  template <class Items, class Write>
  JsonWriter& object_lines(const Items& items, Write write) {
    return objects(items, write, true);
  }
  /// Writes a polygon as a GeoJSON geometry.
  JsonWriter& polygon(const geometry::Polygon& polygon);
  /// Writes a value that is JSON text already. It is not checked. In an object, the text may also be whole members.
  JsonWriter& json(std::string_view raw) {
    return put([=](std::string& text) { text += raw; });
  }
  /// Makes the next item or member start on a new line, without indent.
  void start_line() { starts_line_ = true; }

 private:
  template <class Append>
  JsonWriter& put(Append append) {
    separate();
    append(text_);
    return *this;
  }
  /// Writes what must be before the next item or member: a comma, a line break, or nothing after a key.
  void separate();
  /// Starts a new line and indents it.
  void break_line();
  std::string& text_;
  Layout layout_;
  std::size_t depth_ = 0;     ///< number of open brackets
  bool is_first_ = true;      ///< true if the next item or member is the first in its brackets
  bool follows_key_ = false;  ///< true if a key was written and its value not yet
  bool starts_line_ = false;  ///< true if start_line() was called for the next item or member
};

/// Returns the text of one object and a newline; `write(json)` writes the members.
template <class Write>
std::string json_object(Write write, JsonWriter::Layout layout = JsonWriter::Layout::kLine) {
  std::string text;
  JsonWriter json(text, layout);
  json.object([&] { write(json); });
  return text + '\n';
}

/// Returns a value as indented JSON with a final line break. Lists that contain only numbers, also in nested lists such
/// as outlines, stay on one line. The same value always gives the same text, so that the text can be hashed.
std::string to_json_text(const JsonValue& value);

/// Writes a GeoJSON FeatureCollection of one instant with one feature per line. Coordinates are written as they are
/// given. For each feature, start() opens its properties, the caller writes them, and end_with() closes them and writes
/// the geometry. finish() ends the collection. The object must not be moved or copied, because its writer refers to its
/// text.
class GeojsonLayer {
 public:
  /// `time` [s] is that of the instant, and is written as "t_s". `members` are further members of the collection as
  /// JSON text without braces (place_members); may be empty.
  explicit GeojsonLayer(double time, std::string_view members = {});

  /// Begins a feature. Returns the writer for the members of its properties.
  JsonWriter& start();
  void end_with(const geometry::Polygon& polygon);                ///< ends it with a Polygon
  void end_with(const std::vector<geometry::Polygon>& polygons);  ///< ends it with a MultiPolygon
  void end_with(const geometry::Ring& line);                      ///< ends it with a LineString
  void end_with(geometry::Point point);                           ///< ends it with a Point
  /// Returns the text written since the last take(). A caller that takes it often writes a long layer with little
  /// memory.
  std::string take() { return std::exchange(text_, {}); }
  std::size_t size() const { return text_.size(); }  ///< length of the text not yet taken [bytes]
  /// Ends the collection, and returns the rest of the text, which take() has not returned.
  std::string finish();

 private:
  /// Closes the properties and begins the geometry; its coordinates must follow.
  JsonWriter& open_geometry(const char* type);

  std::string text_;  ///< text not yet taken
  JsonWriter json_;   ///< writes to text_
};

}  // namespace polynya::io
