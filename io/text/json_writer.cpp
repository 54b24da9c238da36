#include "io/text/json_writer.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace polynya::io {

void append_number(std::string& text, double value) {
  if (!std::isfinite(value)) {
    text += "null";
    return;
  }
  char digits[32];
  const auto end = std::to_chars(digits, digits + sizeof digits, value + 0.0).ptr;  // adding 0.0 turns −0 into 0
  text.append(digits, end);
}

void append_number(std::string& text, std::int64_t value) {
  char digits[24];
  const auto end = std::to_chars(digits, digits + sizeof digits, value).ptr;
  text.append(digits, end);
}

void append_text(std::string& text, std::string_view value) {
  static constexpr char kHex[] = "0123456789abcdef";
  text += '"';
  for (const char c : value) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '"' || c == '\\') {
      text += '\\';
      text += c;
    } else if (c == '\n') {
      text += "\\n";
    } else if (byte < 0x20) {
      text += "\\u00";
      text += kHex[byte >> 4];
      text += kHex[byte & 15];
    } else {
      text += c;
    }
  }
  text += '"';
}

std::string escaped(std::string_view text) {
  std::string safe;
  for (const char c : text) {
    if (c == '&')
      safe += "&amp;";
    else if (c == '<')
      safe += "&lt;";
    else if (c == '>')
      safe += "&gt;";
    else if (c == '"')
      safe += "&quot;";
    else if (c == '\'')
      safe += "&#39;";
    else
      safe += c;
  }
  return safe;
}

std::string to_base64(std::string_view bytes) {
  static constexpr char kDigits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t count = bytes.size() - i < 3 ? bytes.size() - i : 3;
    std::uint32_t group = 0;
    for (std::size_t k = 0; k < 3; ++k) group = group << 8 | (k < count ? static_cast<std::uint8_t>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? kDigits[group >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

namespace {

void append_point(std::string& text, geometry::Point point) {
  text += '[';
  append_number(text, point.x);
  text += ',';
  append_number(text, point.y);
  text += ']';
}

}  // namespace

void JsonWriter::break_line() {
  text_ += '\n';
  text_.append(2 * depth_, ' ');
}

void JsonWriter::separate() {
  if (follows_key_) {
    follows_key_ = false;
    return;
  }
  if (!is_first_) text_ += ',';
  if (layout_ == Layout::kIndented && depth_ > 0) break_line();
  if (std::exchange(starts_line_, false)) text_ += '\n';
  is_first_ = false;
}

JsonWriter& JsonWriter::open(char bracket) {
  separate();
  text_ += bracket;
  ++depth_;
  is_first_ = true;
  return *this;
}

JsonWriter& JsonWriter::close(char bracket) {
  --depth_;
  if (layout_ == Layout::kIndented && !is_first_) break_line();
  text_ += bracket;
  is_first_ = false;
  return *this;
}

JsonWriter& JsonWriter::key(std::string_view name) {
  separate();
  append_text(text_, name);
  text_ += layout_ == Layout::kIndented ? ": " : ":";
  follows_key_ = true;
  return *this;
}

JsonWriter& JsonWriter::value(geometry::Point point) {
  return put([=](std::string& text) { append_point(text, point); });
}

JsonWriter& JsonWriter::value(const geometry::Ring& ring) {
  return put([&](std::string& text) {
    text += '[';
    for (std::size_t i = 0; i < ring.size(); ++i) append_point(i > 0 ? text += ',' : text, ring[i]);
    text += ']';
  });
}

JsonWriter& JsonWriter::value(const geometry::Polygon& polygon) {
  const auto closed = [this](geometry::Ring ring) {
    if (!ring.empty()) ring.push_back(ring.front());
    value(ring);
  };
  open('[');
  closed(polygon.outer);
  std::ranges::for_each(polygon.holes, closed);
  return close(']');
}

JsonWriter& JsonWriter::polygon(const geometry::Polygon& polygon) {
  return open('{').key("type").value("Polygon").key("coordinates").value(polygon).close('}');
}

namespace {

void append_flat(std::string& text, const JsonValue& value) {
  if (!value.is(JsonValue::Kind::kArray)) return append_number(text, value.number());
  text += '[';
  for (std::size_t i = 0; i < value.items().size(); ++i) {
    if (i > 0) text += ", ";
    append_flat(text, value.items()[i]);
  }
  text += ']';
}

bool holds_only_numbers(const JsonValue& value) {
  if (value.is(JsonValue::Kind::kNumber)) return true;
  return value.is(JsonValue::Kind::kArray) && std::ranges::all_of(value.items(), holds_only_numbers);
}

/// Writes the value of each kind of a JsonValue.
struct ValueWriter {
  JsonWriter& json;

  void operator()(const auto& plain) const { json.value(plain); }
  void operator()(const JsonValue::Array& items) const {
    json.open('[');
    for (const JsonValue& item : items) write(item);
    json.close(']');
  }
  void operator()(const JsonValue::Object& members) const {
    json.open('{');
    for (const JsonMember& member : members) {
      json.key(member.key);
      write(member.value);
    }
    json.close('}');
  }
  void write(const JsonValue& value) const {
    if (!value.is(JsonValue::Kind::kArray) || !holds_only_numbers(value)) return std::visit(*this, value.data);
    std::string flat;
    append_flat(flat, value);
    json.json(flat);
  }
};

}  // namespace

std::string to_json_text(const JsonValue& value) {
  std::string text;
  JsonWriter json(text, JsonWriter::Layout::kIndented);
  ValueWriter{json}.write(value);
  return text + "\n";
}

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

GeojsonLayer::GeojsonLayer(double time, std::string_view members) : json_(text_) {
  json_.open('{').key("type").value("FeatureCollection").key("t_s").value(time);
  if (!members.empty()) json_.json(members);
  json_.key("features").open('[');
}

JsonWriter& GeojsonLayer::start() {
  json_.start_line();
  return json_.open('{').key("type").value("Feature").key("properties").open('{');
}

JsonWriter& GeojsonLayer::open_geometry(const char* type) {
  return json_.close('}').key("geometry").open('{').key("type").value(type).key("coordinates");
}

void GeojsonLayer::end_with(const Polygon& polygon) {
  open_geometry("Polygon").value(polygon).close('}').close('}');
}

void GeojsonLayer::end_with(const std::vector<Polygon>& polygons) {
  open_geometry("MultiPolygon").open('[');
  for (const Polygon& polygon : polygons) json_.value(polygon);
  json_.close(']').close('}').close('}');
}

void GeojsonLayer::end_with(const Ring& line) {
  open_geometry("LineString").value(line).close('}').close('}');
}

void GeojsonLayer::end_with(Point point) {
  open_geometry("Point").value(point).close('}').close('}');
}

std::string GeojsonLayer::finish() {
  json_.close(']').close('}');
  return std::move(text_) + "\n";
}

}  // namespace polynya::io
