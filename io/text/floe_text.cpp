#include "io/text/floe_text.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "geometry/exact/measures.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"
#include "io/text/wkt.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

/// What Polynya writes of each piece in place of its parent's.
constexpr std::string_view kOwnProperties[] = {"floe_id", "parent_id", "area_m2", "part"};

/// Ends the reading of one feature.
struct ParseError : std::runtime_error {
  ParseError(std::string_view why, const std::string& detail) : std::runtime_error(detail), reason(why) {}
  std::string_view reason;
};

class GeojsonEntries {
 public:
  GeojsonEntries(FloeText& floes, std::string_view text) : floes_(floes), text_(text) {}

  /// Everything in a GeoJSON value, as one feature after the other from `feature` on.
  void read(const JsonValue& value, std::size_t feature) {
    note_crs(value);
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
    properties_ = nullptr;
    const JsonValue* geometry = &value;
    if (value.has("type", "Feature")) {
      note_crs(value);
      geometry = value.find("geometry");
      if (const JsonValue* properties = value.find("properties")) {
        floe_id_ = floe_id_in(*properties, "floe_id");
        properties_ = kept_of(*properties);
        if (const JsonValue* area = properties->find("area_m2", JsonKind::kNumber))
          floes_.stated_area += area->number();
      }
      if (!geometry || geometry->is_null()) return refuse(value, "no-geometry", "a feature without geometry");
    }
    attempt(*geometry, [&] { read_geometry(*geometry); });
  }

  /// What is refused inside is recorded here, and what stands beside it is read.
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

  /// A feature's properties without those that Polynya writes itself.
  std::shared_ptr<const std::string> kept_of(const JsonValue& properties) const {
    if (!properties.is(JsonKind::kObject) || text_.empty()) return nullptr;
    std::string kept;
    for (const JsonMember& member : properties.members()) {
      if (std::ranges::find(kOwnProperties, member.key) != std::end(kOwnProperties)) continue;
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
    entry.properties = properties_;
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
    // null and (after parse_lenient_json) empty texts stand for what JSON cannot write.
    if (value.is_null() || (value.is(JsonKind::kText) && value.text().empty()))
      return std::numeric_limits<double>::quiet_NaN();
    throw ParseError("malformed", fmt::format("found {}, expected a coordinate", name_of(value.kind())));
  }

  FloeText& floes_;
  std::string_view text_;
  std::size_t feature_ = 0;
  std::size_t member_ = 0;
  std::optional<std::int64_t> floe_id_;
  std::shared_ptr<const std::string> properties_;
};

// What kind of text it is, by its lines.

/// Whether a trimmed line is a comment: '#' or '//' to its end.
bool is_comment(std::string_view line) {
  return line.starts_with('#') || line.starts_with("//");
}

/// Calls use(line, offset) for each line that is neither blank nor a comment.
template <class Use>
void for_lines(std::string_view text, Use use) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = text.substr(start, end - start);
    if (const auto words = trimmed(line); !words.empty() && !is_comment(words)) use(line, start);
    start = end + 1;
  }
}

/// What kinds of lines a text of floes has. Blank lines and comments do not count.
struct LineCounts {
  std::size_t lines = 0;
  std::size_t objects = 0;  ///< from '{' to '}': a line of NDJSON, sound or not
  std::size_t wkt = 0;      ///< begin with a WKT geometry
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

/// Blanks for comments that begin a line with '#', which JSON's parser refuses.
void blank_hash_comments(std::string& text) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::size_t first = text.find_first_not_of(kBlanks, start);
    if (first < end && text[first] == '#') std::fill(&text[first], &text[end], ' ');
    start = end + 1;
  }
}

/// Without the line of a place in a text of one line.
std::string without_line(const std::string& words) {
  return words.starts_with("1:") ? "column " + words.substr(2) : words;
}

void add_syntax_error(FloeText& floes, std::size_t feature, std::uint32_t offset, std::string detail) {
  FloeEntry& entry = floes.entries.emplace_back();
  entry.feature = feature;
  entry.offset = offset;
  entry.refusal = "syntax";
  entry.detail = std::move(detail);
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

FloeText read_wkt_floes(std::string_view text) {
  FloeText floes;
  floes.format = FloeFormat::kWkt;
  std::size_t feature = 0;
  for (const WktGeometry& geometry : read_wkt(text)) {
    floes.has_srid = floes.has_srid || geometry.has_srid;
    if (geometry.error.empty())
      GeojsonEntries(floes, "").read(geometry.geojson, feature);
    else
      add_syntax_error(floes, feature, geometry.offset, geometry.error);
    ++feature;
  }
  return floes;
}

constexpr double kPolarLatitude = 40;  ///< [°]
constexpr double kLeastIce = 1;        ///< of a scene in metres [m²]
constexpr double kMostPolarIce = 100;  ///< of a scene in degrees [°²]

std::string unknown_text(std::string_view first_line) {
  constexpr std::size_t kMost = 30;  // bytes of it in the message
  std::string begin(first_line.substr(0, kMost));
  std::ranges::replace_if(
      begin, [](char c) { return static_cast<unsigned char>(c) < 0x20 || (c & 0x80) != 0; }, '?');
  return fmt::format(
      "neither GeoJSON, nor NDJSON (a GeoJSON object a line), nor WKT: it begins with '{}'{}; other formats: "
      "ogr2ogr -f GeoJSON floes.geojson FILE",
      begin, first_line.size() > kMost ? " …" : "");
}

/// Decides by the lines what the text is, and reads it.
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
  if (lines.wkt > 0) return read_wkt_floes(text);
  return fail("1:1: " + unknown_text(lines.first_line));
}

}  // namespace

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
  std::ranges::replace(text, '\x1E', ' ');  // GeoJSON text sequences [RFC8142] start each record with one
  const LineIndex lines(text);
  auto floes = read_kind(text);
  if (!floes) return floes;
  for (FloeEntry& entry : floes->entries) entry.line = static_cast<std::size_t>(lines.line_of(entry.offset));
  return floes;
}

std::string crs_name(const JsonValue& crs) {
  const JsonValue* properties = crs.find("properties");
  if (!properties) return "";
  for (const char* key : {"name", "code"}) {  // of type "name", and of type "EPSG" in older files
    const JsonValue* name = properties->find(key);
    if (name && name->is(JsonValue::Kind::kText)) return name->text();
    if (name && name->is(JsonValue::Kind::kNumber)) return fmt::format("EPSG:{}", name->number());
  }
  return "";
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
  return (floes > 0 && are_all_whole && area < kLeastIce) || look_polar();
}

}  // namespace polynya::io
