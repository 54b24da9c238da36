#include "io/text/wkt.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>

#include <fmt/format.h>

#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

constexpr int kDeepestCollection = 64;

/// Whether it is one of A to Z or a to z.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// What is wrong at the reader's place; ends the geometry it stands in.
struct SyntaxError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

class WktReader {
 public:
  explicit WktReader(std::string_view text) : text_(text) {}

  std::vector<WktGeometry> read() {
    std::vector<WktGeometry> geometries;
    for (skip_between(); at_ < text_.size(); skip_between()) {
      WktGeometry& geometry = geometries.emplace_back();
      geometry.offset = static_cast<std::uint32_t>(at_);
      try {
        const std::size_t begin = at_;
        geometry.has_srid = take_word() == "SRID";
        at_ = geometry.has_srid ? std::min(text_.find_first_of(";\n", at_), text_.size()) : begin;
        if (geometry.has_srid && !take(';')) fail("';'");
        geometry.geojson = read_geometry(0);
      } catch (const SyntaxError& error) {
        geometry.error = error.what();
        at_ = std::min(text_.find('\n', at_), text_.size());
      }
    }
    return geometries;
  }

 private:
  void skip_blanks() {
    for (; at_ < text_.size(); ++at_) {
      const bool is_comment = text_[at_] == '#' || text_.substr(at_, 2) == "//";
      if (!is_comment && kBlanks.find(text_[at_]) == kBlanks.npos) return;
      if (is_comment) at_ = std::min(text_.find('\n', at_), text_.size() - 1);
    }
  }
  void skip_between() {
    skip_blanks();
    while (take(';')) skip_blanks();
  }
  bool take(char expected) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }
  [[noreturn]] void fail(std::string_view expected) {
    skip_blanks();
    const std::string found = at_ < text_.size() ? fmt::format("'{}'", text_[at_]) : "the end of the text";
    throw SyntaxError(fmt::format("found {}, expected {}", found, expected));
  }
  bool is_at_word() {
    skip_blanks();
    return at_ < text_.size() && is_letter(text_[at_]);
  }
  /// The next word in upper case; empty where none stands here.
  std::string take_word() {
    std::string word;
    skip_blanks();
    for (; at_ < text_.size() && is_letter(text_[at_]); ++at_) word += static_cast<char>(text_[at_] & ~0x20);
    return word;
  }

  JsonValue read_geometry(int depth) {
    if (depth > kDeepestCollection) throw SyntaxError("collections nested too deep");
    if (!is_at_word()) fail("the name of a geometry");
    JsonValue geometry{JsonValue::Object{}, static_cast<std::uint32_t>(at_)};
    std::string type = take_word(), next;
    while (is_at_word() && next != "EMPTY") next = take_word();
    // "POLYGON Z" and "POLYGONZ" are both written.
    while (type.size() > 1 && (type.back() == 'Z' || type.back() == 'M')) type.pop_back();
    const bool is_collection = type == "GEOMETRYCOLLECTION";
    for (const auto& [upper, name] : {std::pair{"POLYGON", "Polygon"},
                                      {"MULTIPOLYGON", "MultiPolygon"},
                                      {"GEOMETRYCOLLECTION", "GeometryCollection"}})
      if (type == upper) type = name;
    geometry.set("type", type);
    JsonValue list{JsonValue::Array{}, geometry.offset};
    if (next != "EMPTY") list = read_list([&] { return is_collection ? read_geometry(depth + 1) : read_item(0); });
    geometry.members().push_back({is_collection ? "geometries" : "coordinates", list.offset, std::move(list)});
    return geometry;
  }

  /// What holds nothing is left out: GEOS writes empty holes.
  template <class Read>
  JsonValue read_list(Read read) {
    skip_blanks();
    JsonValue list{JsonValue::Array{}, static_cast<std::uint32_t>(at_)};
    if (!take('(')) fail("'('");
    do {
      if (const std::size_t begin = at_; is_at_word() && take_word() == "EMPTY")
        continue;
      else
        at_ = begin;
      list.items().push_back(read());
    } while (take(','));
    if (!take(')')) fail("')'");
    return list;
  }
  /// A list, or a point: two to four numbers.
  JsonValue read_item(int depth) {
    if (depth > kDeepestCollection) throw SyntaxError("brackets nested too deep");
    skip_blanks();
    if (at_ < text_.size() && text_[at_] == '(') return read_list([&] { return read_item(depth + 1); });
    JsonValue point{JsonValue::Array{}, static_cast<std::uint32_t>(at_)};
    do {
      point.items().push_back({read_number(), point.offset});
      skip_blanks();
    } while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != ')');
    return point;
  }
  double read_number() {
    skip_blanks();
    const std::size_t sign = at_ < text_.size() && text_[at_] == '+' ? 1 : 0;
    const char* const start = text_.data() + at_ + sign;
    double value = 0;
    const auto [end, error] = std::from_chars(start, text_.data() + text_.size(), value);
    if (end == start) fail("a number");
    // Out of range is either too small or too large: strtod returns 0 or infinity.
    if (error != std::errc{}) value = std::strtod(std::string(start, end).c_str(), nullptr);
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

void append_ring(std::string& text, const geometry::Ring& ring) {
  text += '(';
  for (std::size_t i = 0; i <= ring.size() && !ring.empty(); ++i) {
    if (i > 0) text += ", ";
    append_number(text, ring[i % ring.size()].x);
    text += ' ';
    append_number(text, ring[i % ring.size()].y);
  }
  text += ')';
}

}  // namespace

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

bool begins_wkt(std::string_view line) {
  const auto end_of_word = static_cast<std::size_t>(std::ranges::find_if_not(line, is_letter) - line.begin());
  std::string word(line.substr(0, end_of_word));
  for (char& c : word) c = static_cast<char>(c & ~0x20);  // upper case
  const auto begins = [&](std::string_view name) { return word.starts_with(name); };
  if (begins("POLYGON") || begins("MULTIPOLYGON") || begins("GEOMETRYCOLLECTION") || begins("SRID") ||
      begins("POINT") || begins("LINESTRING") || begins("MULTIPOINT") || begins("MULTILINESTRING"))
    return true;
  return !word.empty() && trimmed(line.substr(end_of_word)).starts_with('(');
}

std::vector<WktGeometry> read_wkt(std::string_view text) {
  return WktReader(text).read();
}

void append_wkt(std::string& text, const geometry::Polygon& polygon) {
  text += "POLYGON (";
  append_ring(text, polygon.outer);
  for (const geometry::Ring& hole : polygon.holes) {
    text += ", ";
    append_ring(text, hole);
  }
  text += ')';
}

}  // namespace polynya::io
