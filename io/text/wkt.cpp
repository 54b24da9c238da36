#include "io/text/wkt.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>
#include <stdexcept>
#include <utility>

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
      geometry.offset = at_;
      try {
        read_geometry(geometry, 0);
      } catch (const SyntaxError& error) {
        geometry.polygons.clear();
        geometry.refusal = "syntax";
        geometry.detail = error.what();
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
    while (at_ < text_.size() && text_[at_] == ';') {
      ++at_;
      skip_blanks();
    }
  }
  bool take(char expected) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != expected) return false;
    ++at_;
    return true;
  }
  void expect(char expected) {
    if (!take(expected)) fail(fmt::format("'{}'", expected));
  }
  [[noreturn]] void fail(std::string_view expected) {
    skip_blanks();
    const std::string found = at_ < text_.size() ? fmt::format("'{}'", text_[at_]) : "the end of the text";
    throw SyntaxError(fmt::format("found {}, expected {}", found, expected));
  }
  /// The next word in upper case; empty where none stands here.
  std::string take_word() {
    skip_blanks();
    std::string word;
    for (; at_ < text_.size() && is_letter(text_[at_]); ++at_) word += static_cast<char>(text_[at_] & ~0x20);
    return word;
  }

  void read_geometry(WktGeometry& geometry, int depth) {
    std::string type = take_word();
    if (type == "SRID") {
      geometry.has_srid = true;
      at_ = std::min(text_.find_first_of(";\n", at_), text_.size());
      expect(';');
      type = take_word();
    }
    if (type.empty()) fail("the name of a geometry");
    const std::size_t behind_type = at_;
    const std::string dimensions = take_word();
    if (dimensions == "EMPTY") return read_empty(geometry, type);
    // "POLYGON Z" and "POLYGONZ" are both written.
    if (dimensions != "Z" && dimensions != "M" && dimensions != "ZM") at_ = behind_type;
    if (dimensions != "" && at_ != behind_type && take_word() == "EMPTY") return read_empty(geometry, type);
    while (type.size() > 1 && (type.back() == 'Z' || type.back() == 'M')) type.pop_back();
    if (type == "POLYGON") {
      geometry.polygons.push_back(read_polygon(geometry));
    } else if (type == "MULTIPOLYGON") {
      read_list([&] {
        if (!take_empty()) geometry.polygons.push_back(read_polygon(geometry));
      });
    } else if (type == "GEOMETRYCOLLECTION") {
      if (depth >= kDeepestCollection) throw SyntaxError("collections nested too deep");
      read_list([&] { read_geometry(geometry, depth + 1); });
    } else {
      refuse(geometry, type);
      pass_brackets();
    }
  }
  static void read_empty(WktGeometry& geometry, const std::string& type) {
    if (type == "POLYGON")
      geometry.polygons.emplace_back();
    else if (type != "MULTIPOLYGON" && type != "GEOMETRYCOLLECTION")
      refuse(geometry, type);
  }
  static void refuse(WktGeometry& geometry, const std::string& type) {
    geometry.refusal = "not-a-polygon";
    geometry.detail = fmt::format("found {}, expected POLYGON, MULTIPOLYGON or GEOMETRYCOLLECTION", type);
  }

  template <class Read>
  void read_list(Read read) {
    expect('(');
    do {
      read();
    } while (take(','));
    expect(')');
  }
  /// What holds nothing may stand for a polygon of several or for a ring.
  bool take_empty() {
    skip_blanks();
    if (at_ >= text_.size() || !is_letter(text_[at_])) return false;
    if (take_word() != "EMPTY") fail("'(' or EMPTY");
    return true;
  }
  geometry::Polygon read_polygon(WktGeometry& geometry) {
    geometry::Polygon polygon;
    bool is_first = true;
    read_list([&] {
      const bool is_shell = std::exchange(is_first, false);
      if (take_empty()) return;  // GEOS writes empty holes; an empty shell is left without points
      geometry::Ring& ring = is_shell ? polygon.outer : polygon.holes.emplace_back();
      read_list([&] { ring.push_back(read_point(geometry)); });
    });
    return polygon;
  }
  geometry::Point read_point(WktGeometry& geometry) {
    const double x = read_number();
    const double y = read_number();
    for (int more = 0; more < 2; ++more) {
      skip_blanks();
      if (at_ >= text_.size() || text_[at_] == ',' || text_[at_] == ')') break;
      read_number();
      geometry.has_more_coordinates = true;
    }
    return {x, y};
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
  void pass_brackets() {
    expect('(');
    for (int open = 1; open > 0; ++at_) {
      if (at_ >= text_.size()) fail("')'");
      if (text_[at_] == '(') ++open;
      if (text_[at_] == ')') --open;
    }
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
