#include "io/text/floe_text.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/angle.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

/// Properties that Polynya writes for each piece; it does not copy them from the floe that was cut.
constexpr std::string_view kOwnProperties[] = {"floe_id", "parent_id", "area_m2", "part"};

/// Thrown to end the reading of one feature.
struct ParseError : std::runtime_error {
  ParseError(std::string_view why, const std::string& detail) : std::runtime_error(detail), reason(why) {}
  std::string_view reason;
};

class GeojsonEntries {
 public:
  GeojsonEntries(FloeText& floes, std::string_view text) : floes_(floes), text_(text) {}

  /// Reads all polygons of a GeoJSON value. Its features are numbered from `feature` on.
  void read(const JsonValue& value, std::size_t feature) {
    note_crs(value);
    note_place(value);
    if (const JsonValue* time = value.find("t_s", JsonKind::kNumber)) floes_.time = time->number();
    if (value.has("type", "FeatureCollection")) {
      const JsonValue* features = value.find("features", JsonKind::kArray);
      if (!features) {
        feature_ = feature;
        return refuse(value, "malformed", "a FeatureCollection without features");
      }
      for (const JsonValue& item : features->items()) read_feature(item, feature++);
    } else {
      read_feature(value, feature);
    }
  }

 private:
  FloeEntry& add_entry(const JsonValue& value) {
    FloeEntry& entry = floes_.entries.emplace_back();
    entry.feature = feature_;
    entry.member = member_++;
    entry.offset = value.offset;
    entry.floe_id = floe_id_;
    entry.other_id = other_id_;
    entry.properties = properties_;
    entry.own_properties = own_properties_;
    return entry;
  }

  void refuse(const JsonValue& value, std::string_view reason, const std::string& detail) {
    FloeEntry& entry = add_entry(value);
    entry.refusal = reason;
    entry.detail = detail;
  }

  void read_feature(const JsonValue& value, std::size_t feature) {
    feature_ = feature;
    member_ = 0;
    floe_id_ = {};
    other_id_ = {};
    properties_ = own_properties_ = nullptr;
    const JsonValue* geometry = &value;
    if (value.has("type", "Feature")) {
      note_crs(value);
      geometry = value.find("geometry");
      if (const JsonValue* properties = value.find("properties")) {
        floe_id_ = floe_id_in(*properties, "floe_id");
        if (!floe_id_) note_other_id(*properties, "floe_id");
        properties_ = members_of(*properties, false);
        own_properties_ = members_of(*properties, true);
        if (const JsonValue* area = properties->find("area_m2", JsonKind::kNumber))
          floes_.stated_area += area->number();
      }
      if (!floe_id_ && !other_id_) note_other_id(value, "id");
      if (!geometry || geometry->is_null()) return refuse(value, "no-geometry", "a feature without geometry");
    }
    attempt(*geometry, [&] { read_geometry(*geometry); });
  }

  /// Calls `read` and stores an entry with the reason if it throws ParseError, so that the rest of the text is still
  /// read.
  template <class Read>
  void attempt(const JsonValue& value, Read read) {
    try {
      read();
    } catch (const ParseError& error) {
      refuse(value, error.reason, error.what());
    }
  }

  void note_crs(const JsonValue& value) {
    const JsonValue* crs = value.find("crs");
    if (!crs || text_.empty()) return;
    const std::string found = compact_json(text_, crs->offset);
    if (floes_.crs.empty()) floes_.crs = found;
    floes_.has_other_crs = floes_.has_other_crs || found != floes_.crs;
  }

  /// Reads the place of a file that Polynya wrote. Other programs may write an "origin" too; it has no latitude and is
  /// ignored.
  void note_place(const JsonValue& value) {
    StatedPlace& place = floes_.place;
    const auto is_within = [](const JsonValue* number, double least, double most) {
      return number && number->is(JsonKind::kNumber) && number->number() >= least && number->number() <= most;
    };
    if (const JsonValue* origin = value.find("origin"); origin && origin->find("latitude_deg")) {
      const JsonValue *latitude = origin->find("latitude_deg"), *longitude = origin->find("longitude_deg");
      const JsonValue* heading = origin->find("heading_deg");
      if (is_within(latitude, -90, 90) && is_within(longitude, -360, 360) &&
          (!heading || is_within(heading, -360, 360)))
        place.origin = {latitude->number() * geometry::kRadiansPerDegree,
                        longitude->number() * geometry::kRadiansPerDegree,
                        (heading ? heading->number() : 90) * geometry::kRadiansPerDegree};
      else
        place.wrong = "its \"origin\" is not latitude_deg, longitude_deg and heading_deg in degrees";
    }
    if (const JsonValue* crs = value.find("shifted_crs", JsonKind::kText)) place.shifted_crs = crs->text();
    if (const JsonValue* shift = value.find("shift_m")) {
      const bool is_shift = shift->is(JsonKind::kArray) && shift->items().size() == 2 &&
                            is_within(&shift->items()[0], -1e8, 1e8) && is_within(&shift->items()[1], -1e8, 1e8);
      if (is_shift)
        place.shift = {shift->items()[0].number(), shift->items()[1].number()};
      else
        place.wrong = "its \"shift_m\" is not [x, y] in metres";
    }
  }

  void note_other_id(const JsonValue& object, std::string_view key) {
    const JsonValue* id = object.find(key);
    if (id && !id->is_null() && !text_.empty()) other_id_ = compact_json(text_, id->offset);
  }

  /// Returns the properties of a feature as JSON: those that Polynya itself writes, or all others.
  std::shared_ptr<const std::string> members_of(const JsonValue& properties, bool are_own) const {
    if (!properties.is(JsonKind::kObject) || text_.empty()) return nullptr;
    std::string kept;
    for (const JsonMember& member : properties.members()) {
      if ((std::ranges::find(kOwnProperties, member.key) != std::end(kOwnProperties)) != are_own) continue;
      if (!kept.empty()) kept += ',';
      append_text(kept, member.key);
      kept += ':' + compact_json(text_, member.value.offset);
    }
    return kept.empty() ? nullptr : std::make_shared<const std::string>(std::move(kept));
  }

  void read_geometry(const JsonValue& value) {
    const JsonValue* type = value.find("type", JsonKind::kText);
    if (!type)
      throw ParseError("malformed",
                       fmt::format("found {}, expected an object with a GeoJSON type",
                                   value.is(JsonKind::kObject) ? "an object without one" : name_of(value.kind())));
    if (type->text() == "GeometryCollection") {
      const JsonValue* geometries = value.find("geometries");
      if (!geometries) throw ParseError("malformed", "a GeometryCollection without geometries");
      for (const JsonValue& item : list(*geometries, "a list of geometries"))
        attempt(item, [&] { read_geometry(item); });
      return;
    }
    if (type->text() != "Polygon" && type->text() != "MultiPolygon") {
      throw ParseError("not-a-polygon", fmt::format("found {}, expected Polygon, MultiPolygon or GeometryCollection",
                                                    type->text().substr(0, 40)));
    }
    const JsonValue* coordinates = value.find("coordinates");
    if (!coordinates) throw ParseError("malformed", "no coordinates");
    if (type->text() == "Polygon") return add(value, polygon_of(*coordinates));
    for (const JsonValue& item : list(*coordinates, "a list of polygons"))
      attempt(item, [&] { add(item, polygon_of(item)); });
  }

  void add(const JsonValue& value, geometry::Polygon polygon) {
    FloeEntry& entry = add_entry(value);
    entry.polygon = std::move(polygon);
  }

  static const JsonValue::Array& list(const JsonValue& value, const char* expected) {
    if (!value.is(JsonKind::kArray))
      throw ParseError("malformed", fmt::format("found {}, expected {}", name_of(value.kind()), expected));
    return value.items();
  }

  geometry::Polygon polygon_of(const JsonValue& value) {
    geometry::Polygon polygon;
    bool is_first = true;
    for (const JsonValue& item : list(value, "a list of rings")) {
      (is_first ? polygon.outer : polygon.holes.emplace_back()) = ring_of(item);
      is_first = false;
    }
    return polygon;
  }

  geometry::Ring ring_of(const JsonValue& value) {
    const JsonValue::Array& items = list(value, "a ring, a list of [x, y]");
    geometry::Ring ring;
    ring.reserve(items.size());
    for (const JsonValue& item : items) {
      const JsonValue::Array& numbers = list(item, "[x, y]");
      if (numbers.size() < 2 || numbers.size() > 4)
        throw ParseError("malformed", fmt::format("found {} numbers, expected [x, y]", numbers.size()));
      if (numbers.size() > 2) floes_.has_more_coordinates = true;
      ring.push_back({coordinate(numbers[0]), coordinate(numbers[1])});
    }
    return ring;
  }

  static double coordinate(const JsonValue& value) {
    if (value.is(JsonKind::kNumber)) return value.number();
    // null, and (after parse_lenient_json) an empty text, represent a number that JSON cannot write.
    if (value.is_null() || (value.is(JsonKind::kText) && value.text().empty()))
      return std::numeric_limits<double>::quiet_NaN();
    throw ParseError("malformed", fmt::format("found {}, expected a coordinate", name_of(value.kind())));
  }

  FloeText& floes_;
  std::string_view text_;
  std::size_t feature_ = 0;
  std::size_t member_ = 0;
  std::optional<std::int64_t> floe_id_;
  std::optional<std::string> other_id_;
  std::shared_ptr<const std::string> properties_, own_properties_;
};

void add_syntax_error(FloeText& floes, std::size_t feature, std::size_t offset, std::string detail) {
  FloeEntry& entry = floes.entries.emplace_back();
  entry.feature = feature;
  entry.offset = static_cast<std::uint32_t>(offset);
  entry.refusal = "syntax";
  entry.detail = std::move(detail);
}

/// Deepest nesting of brackets and collections of WKT that is read. It bounds the stack of the recursive reader.
constexpr int kDeepestCollection = 64;

/// Returns true for A to Z and a to z.
bool is_letter(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

/// Describes a syntax error at the reader's place. It ends the geometry that is being read.
struct SyntaxError : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Reads WKT in upper or lower case, with or without Z and M.
class WktReader {
 public:
  explicit WktReader(std::string_view text) : text_(text) {}

  /// Reads the geometries of the text in order; '#' and '//' start comments. After a syntax error reading continues at
  /// the next line.
  FloeText read() {
    FloeText floes;
    floes.format = FloeFormat::kWkt;
    std::size_t number = 0;
    for (skip_between(); at_ < text_.size(); skip_between()) {
      const std::size_t begin = at_;
      try {
        skip_srid(floes);
        GeojsonEntries(floes, "").read(read_geometry(0), number);
      } catch (const SyntaxError& error) {
        add_syntax_error(floes, number, begin, error.what());
        at_ = std::min(text_.find('\n', at_), text_.size());
      }
      ++number;
    }
    return floes;
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
  /// Reads "SRID=…;" and stores it as the coordinate system of the text.
  void skip_srid(FloeText& floes) {
    const std::size_t begin = at_;
    if (take_word() != "SRID") {
      at_ = begin;
      return;
    }
    const std::size_t end = std::min(text_.find_first_of(";\n", at_), text_.size());
    std::string_view number = trimmed(text_.substr(at_, end - at_));
    if (number.starts_with('=')) number = trimmed(number.substr(1));
    const std::string system = number == "0" ? "" : fmt::format("EPSG:{}", number);  // 0 means no system
    floes.has_other_crs = floes.has_other_crs || (floes.has_srid && floes.srid != system);
    floes.has_srid = true;
    floes.srid = system;
    at_ = end;
    if (!take(';')) fail("';'");
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
  /// Reads the next word and returns it in upper case; empty if there is none here.
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
    // Both "POLYGON Z" and "POLYGONZ" are in use.
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

  /// Reads a list. Empty items are left out, because GEOS writes empty holes.
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
  /// Reads a list, or a point of two to four numbers.
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
    // The number is too small or too large for a double: strtod returns 0 or infinity.
    if (error != std::errc{}) value = std::strtod(std::string(start, end).c_str(), nullptr);
    at_ = static_cast<std::size_t>(end - text_.data());
    return value;
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

/// Returns true if a trimmed line begins with the name of a geometry, or with any word before a bracket.
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

// The functions below find out the format of a text from its lines.

/// Returns true if a trimmed line is a comment, which starts with '#' or '//'.
bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//");
}

/// Calls use(line, offset) for each line that is neither blank nor a comment.
template <class Use>
void for_lines(std::string_view text, Use use) {
  for_pieces(text, '\n', [&use](std::string_view line, std::size_t offset) {
    if (const auto words = trimmed(line); !words.empty() && !is_comment(words)) use(line, offset);
  });
}

/// Counts of the kinds of lines in a text of floes. Blank lines and comments are not counted.
struct LineCounts {
  std::size_t lines = 0;
  std::size_t objects = 0;  ///< lines from '{' to '}': lines of NDJSON, valid or not
  std::size_t wkt = 0;      ///< lines that begin with a WKT geometry
  std::string_view first_line;
};

LineCounts count_lines(std::string_view text) {
  LineCounts counts;
  for_lines(text, [&counts](std::string_view whole_line, std::size_t) {
    const std::string_view line = trimmed(whole_line);
    if (counts.lines++ == 0) counts.first_line = line;
    counts.objects += line.starts_with('{') && line.ends_with('}') ? 1 : 0;
    counts.wkt += begins_wkt(line) ? 1 : 0;
  });
  return counts;
}

/// Replaces comment lines that begin with '#' by blanks, because the JSON parser refuses them.
void blank_hash_comments(std::string& text) {
  for_pieces(text, '\n', [&text](std::string_view line, std::size_t offset) {
    if (trimmed(line).starts_with('#'))
      std::fill_n(text.begin() + static_cast<std::ptrdiff_t>(offset), line.size(), ' ');
  });
}

/// Removes the line from a place in a text of one line: "column 5" instead of "1:5".
std::string without_line(const std::string& words) {
  return words.starts_with("1:") ? "column " + words.substr(2) : words;
}

FloeText read_ndjson(const std::string& text) {
  FloeText floes;
  floes.format = FloeFormat::kNdjson;
  std::size_t feature = 0;
  for_lines(text, [&](std::string_view line, std::size_t offset) {
    const std::size_t before = floes.entries.size();
    if (const auto value = parse_lenient_json(line)) {
      GeojsonEntries(floes, line).read(*value, feature);
    } else {
      add_syntax_error(floes, feature, 0, without_line(value.error()));
    }
    for (std::size_t i = before; i < floes.entries.size(); ++i)
      floes.entries[i].offset = static_cast<std::uint32_t>(offset);
    feature = floes.entries.size() > before ? floes.entries.back().feature + 1 : feature + 1;
  });
  return floes;
}

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

constexpr double kPolarLatitude = 40;  ///< floes of polar ice lie beyond this latitude [°]
/// A scene in metres has at least this much ice; less is taken for square degrees [m²].
constexpr double kLeastIceInMetres = 1;
constexpr double kMostPolarIce = 100;  ///< Polar ice of a scene in degrees covers less than this [°²].

std::string unknown_text(std::string_view first_line) {
  constexpr std::size_t kMost = 30;  // bytes of the first line in the message
  std::string begin(first_line.substr(0, kMost));
  std::ranges::replace_if(
      begin, [](char c) { return static_cast<unsigned char>(c) < 0x20 || (c & 0x80) != 0; }, '?');
  return fmt::format(
      "neither GeoJSON, nor NDJSON (a GeoJSON object a line), nor WKT: it begins with '{}'{}; other formats: "
      "ogr2ogr -f GeoJSON floes.geojson FILE",
      begin, first_line.size() > kMost ? " …" : "");
}

/// Finds out the format from the lines, and reads the text.
Result<FloeText> read_kind(std::string& text) {
  const LineCounts lines = count_lines(text);
  FloeText floes;
  floes.format = FloeFormat::kWkt;
  if (lines.lines == 0) return floes;
  if (lines.objects == lines.lines && lines.lines > 1) return read_ndjson(text);
  std::string wrong;
  if (!begins_wkt(lines.first_line)) {
    blank_hash_comments(text);
    const auto value = parse_lenient_json(text);
    if (value) {
      floes.format = FloeFormat::kGeojson;
      GeojsonEntries(floes, text).read(*value, 0);
      return floes;
    }
    wrong = value.error();
  }
  if (2 * lines.objects > lines.lines) return read_ndjson(text);
  if (std::string_view("{[/").find(lines.first_line.front()) != std::string_view::npos)
    return fail(wrong + " (read as GeoJSON)");
  if (lines.wkt > 0) return WktReader(text).read();
  return fail("1:1: " + unknown_text(lines.first_line));
}

}  // namespace

double degrees_in_file(double radians) {
  constexpr double kParts = 1e12;  // Angles are rounded to this fraction of a degree.
  return std::round(geometry::kDegreesPerRadian * radians * kParts) / kParts;
}

void write_place(JsonWriter& json, const StatedPlace& place) {
  if (place.origin) {
    json.key("origin").open('{').key("latitude_deg").value(degrees_in_file(place.origin->latitude));
    json.key("longitude_deg").value(degrees_in_file(place.origin->longitude));
    json.key("heading_deg").value(degrees_in_file(place.origin->heading)).close('}');
  }
  if (!place.shifted_crs.empty()) json.key("shifted_crs").value(place.shifted_crs);
  if (place.shift != geometry::Vector{}) json.key("shift_m").value(place.shift);
}

std::string place_members(const std::optional<simulation::GeographicOrigin>& origin) {
  std::string members;
  JsonWriter json(members);
  write_place(json, {.origin = origin, .shifted_crs = {}, .shift = {}, .wrong = {}});
  return members;
}

bool may_be_floe_text(std::string_view text) {
  const std::string_view first = trimmed(count_lines(text).first_line);
  return first.empty() || first.front() == '{' || first.front() == '[' || begins_wkt(first);
}

std::optional<std::int64_t> floe_id_in(const JsonValue& object, std::string_view key) {
  const JsonValue* id = object.find(key, JsonValue::Kind::kNumber);
  if (!id) return {};
  const double number = id->number();
  if (!(number >= 0 && number < 9e15 && number == std::floor(number))) return {};
  return static_cast<std::int64_t>(number);
}

FloeText read_floe_json(const JsonValue& geojson) {
  FloeText floes;
  GeojsonEntries(floes, "").read(geojson, 0);
  return floes;
}

Result<FloeText> read_floe_text(std::string text) {
  if (text.size() > kLongestFloeText)
    return fail(fmt::format("1:1: {} bytes, more than the {} allowed", text.size(), kLongestFloeText));
  if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
  std::ranges::replace(text, '\x1E', ' ');  // GeoJSON text sequences [RFC8142] start each record with this character.
  const LineIndex lines(text);
  auto floes = read_kind(text);
  if (!floes) return floes;
  for (FloeEntry& entry : floes->entries) entry.line = static_cast<std::size_t>(lines.line_of(entry.offset));
  return floes;
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

std::string crs_name(const std::string& crs) {
  const JsonDocument document = parse_json(crs);
  const JsonValue* properties = document.root.find("properties");
  if (!properties) return "";
  for (const char* key : {"name", "code"}) {  // "name" is current; "code" belongs to the type "EPSG" of older files.
    const JsonValue* name = properties->find(key);
    if (name && name->is(JsonValue::Kind::kText)) return name->text();
    if (name && name->is(JsonValue::Kind::kNumber)) return fmt::format("EPSG:{}", name->number());
  }
  return "";
}

std::string system_of(const FloeText& text) {
  return text.crs.empty() ? text.srid : crs_name(text.crs);
}

bool is_in_degrees(geometry::Point point) {
  return std::abs(point.x) <= 540 && std::abs(point.y) <= 90;
}

void CoordinateEvidence::add(const geometry::Polygon& polygon) {
  if (polygon.outer.empty()) return;
  geometry::Ring within;
  std::ranges::copy_if(polygon.outer, std::back_inserter(within), is_in_degrees);
  ++floes;
  are_all_whole = are_all_whole && within.size() == polygon.outer.size();
  if (2 * within.size() <= polygon.outer.size()) return;
  const geometry::Box of_floe = bounding_box(within);
  if (++in_range == 1) box = of_floe;
  extend(box, of_floe);
  area += std::abs(geometry::signed_area(within));
}

bool CoordinateEvidence::look_polar() const {
  const bool is_far_north_or_south = box.low.y >= kPolarLatitude || box.high.y <= -kPolarLatitude;
  return 2 * in_range > floes && is_far_north_or_south && area < kMostPolarIce;
}

bool CoordinateEvidence::look_like_degrees() const {
  return (floes > 0 && are_all_whole && area < kLeastIceInMetres) || look_polar();
}

}  // namespace polynya::io
