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
/// as 0, numbers that are not finite as null.
void append_number(std::string& text, double value);
void append_number(std::string& text, std::int64_t value);

/// Appends text as a JSON string with its quotes.
void append_text(std::string& text, std::string_view value);

/// Escapes &, < and > of a text for XML (SVG).
std::string escaped(std::string_view text);

/// Bytes as base64 text (RFC 4648, with padding, no line breaks).
std::string to_base64(std::string_view bytes);

/// Writes JSON into a string that the caller owns, so that the string's memory can be used again.
///
///   JsonWriter json(line);
///   json.open('{').key("t_s").value(0.5).key("children").open('[').value(3).close(']').close('}');
class JsonWriter {
 public:
  enum class Layout { kLine, kIndented };
  explicit JsonWriter(std::string& text, Layout layout = Layout::kLine) : text_(text), layout_(layout) {}

  JsonWriter& open(char bracket);
  JsonWriter& close(char bracket);
  JsonWriter& key(std::string_view name);
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
  /// Writes a list of objects; `write(item)` writes the members of each.
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
  /// Writes a value that is JSON text already.
  JsonWriter& json(std::string_view raw) {
    return put([=](std::string& text) { text += raw; });
  }
  /// The next item or member starts on a new line.
  void start_line() { starts_line_ = true; }

 private:
  template <class Append>
  JsonWriter& put(Append append) {
    separate();
    append(text_);
    return *this;
  }
  void separate();
  void break_line();
  std::string& text_;
  Layout layout_;
  std::size_t depth_ = 0;
  bool is_first_ = true;
  bool follows_key_ = false;
  bool starts_line_ = false;
};

/// Returns the text of one object and a newline; `write(json)` writes the members.
template <class Write>
std::string json_object(Write write, JsonWriter::Layout layout = JsonWriter::Layout::kLine) {
  std::string text;
  JsonWriter json(text, layout);
  json.object([&] { write(json); });
  return text + '\n';
}

/// Returns a value as indented JSON. Lists of numbers, and lists of points, stay on one line. The same value always
/// gives the same text.
std::string to_json_text(const JsonValue& value);

/// Writes a GeoJSON FeatureCollection of one instant with one feature per line. start() opens the properties of a
/// feature; end_with() closes them and writes the geometry.
class GeojsonLayer {
 public:
  /// `time` [s] is that of the instant. `members` are further members of the collection as JSON; may be empty.
  explicit GeojsonLayer(double time, std::string_view members = {});

  JsonWriter& start();
  void end_with(const geometry::Polygon& polygon);
  void end_with(const std::vector<geometry::Polygon>& polygons);
  void end_with(const geometry::Ring& line);
  void end_with(geometry::Point point);
  /// Returns the text written since the last take(). A caller that takes it often writes a long layer with little
  /// memory.
  std::string take() { return std::exchange(text_, {}); }
  std::size_t size() const { return text_.size(); }  ///< length of the text not yet taken [bytes]
  std::string finish();

 private:
  JsonWriter& open_geometry(const char* type);

  std::string text_;
  JsonWriter json_;
};

}  // namespace polynya::io
