#include "io/text/geojson_layer.hpp"

#include <algorithm>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>

#include "io/text/birth_shapes.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"

namespace polynya::io {
using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

GeojsonLayer::GeojsonLayer(double time, Project project) : project_(std::move(project)), json_(text_) {
  json_.open('{').key("type").value("FeatureCollection").key("t_s").value(time).key("features").open('[');
}

JsonWriter& GeojsonLayer::start() {
  json_.start_line();
  return json_.open('{').key("type").value("Feature").key("properties").open('{');
}

JsonWriter& GeojsonLayer::open_geometry(const char* type) {
  return json_.close('}').key("geometry").open('{').key("type").value(type).key("coordinates");
}

Ring GeojsonLayer::projected(Ring points) const {
  if (!project_) return points;
  for (Point& p : points) p = project_(p);
  return points;
}

Polygon GeojsonLayer::projected(Polygon polygon) const {
  polygon.outer = projected(std::move(polygon.outer));
  for (Ring& hole : polygon.holes) hole = projected(std::move(hole));
  return polygon;
}

void GeojsonLayer::end_with(const Polygon& polygon) {
  open_geometry("Polygon").value(projected(polygon)).close('}').close('}');
}

void GeojsonLayer::end_with(const std::vector<Polygon>& polygons) {
  open_geometry("MultiPolygon").open('[');
  for (const Polygon& polygon : polygons) json_.value(projected(polygon));
  json_.close(']').close('}').close('}');
}

void GeojsonLayer::end_with(const Ring& line) {
  open_geometry("LineString").value(projected(line)).close('}').close('}');
}

void GeojsonLayer::end_with(Point point) {
  open_geometry("Point").value(project_ ? project_(point) : point).close('}').close('}');
}

std::string GeojsonLayer::finish() {
  json_.close(']').close('}');
  return std::move(text_) + "\n";
}

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
  GeojsonEntries(FloeText& floes, std::string_view text, BirthShapes& births)
      : floes_(floes), text_(text), births_(births) {}

  /// Everything in a GeoJSON value, as one feature after the other from `feature` on; lines are left as
  /// offsets.
  void read(const JsonValue& value, std::size_t feature) {
    note_crs(value);
    if (value.has("type", "FeatureCollection")) {
      const JsonValue* features = value.find("features", JsonKind::kArray);
      if (!features) return refuse(value, feature, "malformed", "a FeatureCollection without features");
      for (const JsonValue& item : features->items()) read_feature(item, feature++);
    } else {
      read_feature(value, feature);
    }
  }

 private:
  void refuse(const JsonValue& value, std::size_t feature, std::string_view reason, const std::string& detail) {
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
    properties_ = nullptr;
    const JsonValue* geometry = &value;
    if (value.has("type", "Feature")) {
      note_crs(value);
      geometry = value.find("geometry");
      if (const JsonValue* properties = value.find("properties")) {
        floe_id_ = floe_id_in(*properties, "floe_id");
        properties_ = kept_of(*properties);
      }
      if (!geometry || geometry->is_null()) return refuse(value, feature, "no-geometry", "a feature without geometry");
    }
    attempt(*geometry, [&] {
      const bool is_birth = geometry->find("ring_m") || geometry->find("ring_parts_m");
      if (is_birth && !geometry->find("type"))
        read_birth(*geometry);
      else
        read_geometry(*geometry);
    });
  }

  /// What is refused inside is recorded here, and what stands beside it is read.
  template <class Read>
  void attempt(const JsonValue& value, Read read) {
    try {
      read();
    } catch (const ParseError& error) {
      refuse(value, feature_, error.reason, error.what());
      ++member_;
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

  /// A line of a run's floes.ndjson.
  void read_birth(const JsonValue& birth) {
    floe_id_ = floe_id_in(birth, "floe_id");
    geometry::Polygon polygon = shape_of(birth);
    if (floe_id_) births_.add_next(*floe_id_);
    add(birth, std::move(polygon));
  }

  geometry::Polygon shape_of(const JsonValue& birth) {
    if (birth.find("ring_parts_m")) {
      auto assembled = births_.assemble(birth);
      if (!assembled) throw ParseError("malformed", assembled.error());
      return std::move(*assembled);
    }
    geometry::Polygon polygon{ring_of(*birth.find("ring_m")), {}};
    if (const JsonValue* holes = birth.find("holes_m")) {
      for (const JsonValue& hole : list(*holes, "a list of holes")) polygon.holes.push_back(ring_of(hole));
    }
    return polygon;
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
    FloeEntry entry;
    entry.polygon = std::move(polygon);
    entry.feature = feature_;
    entry.member = member_++;
    entry.line = value.offset;
    entry.floe_id = floe_id_;
    entry.properties = properties_;
    floes_.entries.push_back(std::move(entry));
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
  BirthShapes& births_;
  std::size_t feature_ = 0;
  std::size_t member_ = 0;
  std::optional<std::int64_t> floe_id_;
  std::shared_ptr<const std::string> properties_;
};

}  // namespace

void read_geojson_entries(const JsonValue& value, std::string_view text, std::size_t feature, FloeText& floes,
                          BirthShapes& births) {
  GeojsonEntries(floes, text, births).read(value, feature);
}

}  // namespace polynya::io
