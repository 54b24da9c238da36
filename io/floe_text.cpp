#include "io/floe_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include <fmt/format.h>

#include "io/lenient_json.hpp"
#include "io/wkt.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

constexpr std::string_view kBlanks = " \t\r\n";

/// Ends the reading of one feature.
struct Refusal : std::runtime_error {
  Refusal(std::string_view why, const std::string& detail) : std::runtime_error(detail), reason(why) {}
  std::string_view reason;
};

/// Where lines start, so that many places in a long text are told quickly.
class LineIndex {
 public:
  explicit LineIndex(std::string_view text) {
    for (std::size_t at = text.find('\n'); at != std::string_view::npos; at = text.find('\n', at + 1))
      ends_.push_back(at);
  }
  std::size_t line_of(std::size_t offset) const {
    return 1 + static_cast<std::size_t>(std::ranges::lower_bound(ends_, offset) - ends_.begin());
  }

 private:
  std::vector<std::size_t> ends_;
};

class GeojsonEntries {
 public:
  explicit GeojsonEntries(FloeText& floes) : floes_(floes) {}

  /// Everything in a GeoJSON value, as one feature after the other from `feature` on; lines are left as
  /// offsets.
  void read(const JsonValue& value, std::size_t feature) {
    const JsonValue* type = value.find("type");
    if (type && type->is(JsonKind::kText) && type->text() == "FeatureCollection") {
      const JsonValue* features = value.find("features");
      if (!features || !features->is(JsonKind::kArray))
        return refuse(value, feature, "malformed", "a FeatureCollection without features");
      for (const JsonValue& item : features->items()) read_feature(item, feature++);
    } else {
      read_feature(value, feature);
    }
  }

 private:
  void refuse(const JsonValue& value, std::size_t feature, std::string_view reason,
              const std::string& detail) {
    FloeEntry entry;
    entry.feature = feature;
    entry.member = member_;
    entry.line = value.offset;
    entry.floe_id = floe_id_;
    entry.refusal = reason;
    entry.detail = detail;
    floes_.entries.push_back(std::move(entry));
  }

  void read_feature(const JsonValue& value, std::size_t feature) {
    feature_ = feature;
    member_ = 0;
    floe_id_ = {};
    const JsonValue* geometry = &value;
    if (const JsonValue* type = value.find("type");
        type && type->is(JsonKind::kText) && type->text() == "Feature") {
      geometry = value.find("geometry");
      if (const JsonValue* properties = value.find("properties")) floe_id_ = id_in(*properties);
      if (!geometry || geometry->is_null())
        return refuse(value, feature, "no-geometry", "a feature without geometry");
    }
    attempt(*geometry, [&] {
      if (geometry->find("ring_m") && !geometry->find("type"))
        read_birth(*geometry);
      else
        read_geometry(*geometry);
    });
  }

  /// What is refused inside is told here, and what stands beside it is read on.
  template <class Read>
  void attempt(const JsonValue& value, Read read) {
    try {
      read();
    } catch (const Refusal& refusal) {
      refuse(value, feature_, refusal.reason, refusal.what());
      ++member_;
    }
  }

  static std::optional<std::int64_t> id_in(const JsonValue& properties) {
    const JsonValue* id = properties.find("floe_id");
    if (!id || !id->is(JsonKind::kNumber)) return {};
    const double number = id->number();
    if (!(number >= 0 && number < 9e15 && number == std::floor(number))) return {};
    return static_cast<std::int64_t>(number);
  }

  /// A line of a run's floes.ndjson.
  void read_birth(const JsonValue& birth) {
    floe_id_ = id_in(birth);
    geometry::Polygon polygon{ring_of(*birth.find("ring_m")), {}};
    if (const JsonValue* holes = birth.find("holes_m")) {
      for (const JsonValue& hole : list(*holes, "a list of holes")) polygon.holes.push_back(ring_of(hole));
    }
    add(birth, std::move(polygon));
  }

  void read_geometry(const JsonValue& value) {
    const JsonValue* type = value.find("type");
    if (!type || !type->is(JsonKind::kText))
      throw Refusal("malformed", "an object with a GeoJSON type is expected");
    if (type->text() == "GeometryCollection") {
      const JsonValue* geometries = value.find("geometries");
      if (!geometries) throw Refusal("malformed", "a GeometryCollection without geometries");
      for (const JsonValue& item : list(*geometries, "a list of geometries"))
        attempt(item, [&] { read_geometry(item); });
      return;
    }
    if (type->text() != "Polygon" && type->text() != "MultiPolygon") {
      throw Refusal("not-a-polygon",
                    fmt::format("found {}, expected Polygon, MultiPolygon or GeometryCollection",
                                type->text().substr(0, 40)));
    }
    const JsonValue* coordinates = value.find("coordinates");
    if (!coordinates) throw Refusal("malformed", "no coordinates");
    if (type->text() == "Polygon") return add(value, polygon_of(*coordinates));
    for (const JsonValue& item : list(*coordinates, "a list of polygons"))
      attempt(item, [&] { add(item, polygon_of(item)); });
  }

  void add(const JsonValue& value, geometry::Polygon polygon) {
    FloeEntry entry;
    entry.polygon = std::move(polygon);
    entry.feature = feature_;
    entry.member = member_++;
    entry.line = value.offset;
    entry.floe_id = floe_id_;
    floes_.entries.push_back(std::move(entry));
  }

  static const JsonValue::Array& list(const JsonValue& value, const char* expected) {
    if (!value.is(JsonKind::kArray))
      throw Refusal("malformed", fmt::format("found {}, expected {}", name_of(value.kind()), expected));
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
        throw Refusal("malformed", fmt::format("found {} numbers, expected [x, y]", numbers.size()));
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
    throw Refusal("malformed", fmt::format("found {}, expected a coordinate", name_of(value.kind())));
  }

  FloeText& floes_;
  std::size_t feature_ = 0;
  std::size_t member_ = 0;
  std::optional<std::int64_t> floe_id_;
};

std::string_view trimmed(std::string_view line) {
  const std::size_t first = line.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return {};
  return line.substr(first, line.find_last_not_of(kBlanks) + 1 - first);
}

/// Calls use(line, offset) for each line that is not blank until it returns false.
template <class Use>
void for_lines(std::string_view text, Use use) {
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find('\n', start), text.size());
    const std::string_view line = text.substr(start, end - start);
    if (!trimmed(line).empty() && !use(line, start)) return;
    start = end + 1;
  }
}

/// One object ends where the first line ends, and another starts on the next one.
bool is_ndjson(std::string_view text) {
  int count = 0;
  bool fits = true;
  for_lines(text, [&](std::string_view line, std::size_t) {
    line = trimmed(line);
    fits = fits && line.front() == '{' && (count > 0 || line.back() == '}');
    return fits && ++count < 2;
  });
  return fits && count == 2;
}

FloeText read_ndjson(const std::string& text) {
  FloeText floes;
  floes.format = FloeFormat::kNdjson;
  std::size_t feature = 0;
  for_lines(text, [&](std::string_view line, std::size_t offset) {
    const std::size_t before = floes.entries.size();
    if (auto value = parse_lenient_json(std::string(line))) {
      GeojsonEntries(floes).read(*value, feature);
    } else {
      FloeEntry& entry = floes.entries.emplace_back();
      entry.feature = feature;
      entry.refusal = "syntax";
      entry.detail = value.error();
    }
    for (std::size_t i = before; i < floes.entries.size(); ++i) floes.entries[i].line = offset;
    feature = floes.entries.size() > before ? floes.entries.back().feature + 1 : feature + 1;
    return true;
  });
  return floes;
}

FloeText read_wkt_floes(std::string_view text) {
  FloeText floes;
  floes.format = FloeFormat::kWkt;
  std::vector<WktGeometry> geometries = read_wkt(text);
  for (std::size_t i = 0; i < geometries.size(); ++i) {
    WktGeometry& geometry = geometries[i];
    floes.has_more_coordinates = floes.has_more_coordinates || geometry.has_more_coordinates;
    const auto add = [&]() -> FloeEntry& {
      FloeEntry& entry = floes.entries.emplace_back();
      entry.feature = i;
      entry.line = geometry.offset;
      return entry;
    };
    std::size_t member = 0;
    for (geometry::Polygon& polygon : geometry.polygons) {
      FloeEntry& entry = add();
      entry.member = member++;
      entry.polygon = std::move(polygon);
    }
    if (geometry.refusal.empty()) continue;
    FloeEntry& entry = add();
    entry.member = member;
    entry.refusal = geometry.refusal;
    entry.detail = geometry.detail;
  }
  return floes;
}

}  // namespace

FloeText read_floe_json(const JsonValue& geojson) {
  FloeText floes;
  GeojsonEntries(floes).read(geojson, 0);
  return floes;
}

tl::expected<FloeText, std::string> read_floe_text(std::string text) {
  if (text.size() > kLongestFloeText)
    return tl::unexpected(
        fmt::format("1:1: {} bytes, more than the {} allowed", text.size(), kLongestFloeText));
  if (text.starts_with("\xEF\xBB\xBF")) text.replace(0, 3, "   ");
  std::ranges::replace(text, '\x1E', ' ');  // GeoJSON text sequences [RFC8142] start each record with one
  const std::size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string::npos) return tl::unexpected(std::string("1:1: there is nothing in it"));
  const LineIndex lines(text);
  FloeText floes;
  const char c = text[first];
  if (c == '{' && is_ndjson(text)) {
    floes = read_ndjson(text);
  } else if (c == '{' || c == '[' || c == '/') {
    auto value = parse_lenient_json(std::move(text));
    if (!value) return tl::unexpected(value.error());
    floes = read_floe_json(*value);
  } else if ((c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '#') {
    floes = read_wkt_floes(text);
  } else {
    return tl::unexpected(std::string("1:1: neither GeoJSON, NDJSON nor WKT"));
  }
  for (FloeEntry& entry : floes.entries) entry.line = lines.line_of(entry.line);
  return floes;
}

}  // namespace polynya::io
