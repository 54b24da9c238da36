#include "io/scene/geojson_reader.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/scene/record.hpp"
#include "io/text/degrees.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;

class GeojsonReader {
 public:
  GeojsonReader(std::size_t source, const PropertyNames& names, ProblemCollector& problems)
      : source_(source), names_(names), problems_(problems), near_misses_(names) {}

  void read(const JsonValue& value, const std::string& path) {
    const JsonValue* type = value.find("type", JsonKind::kText);
    if (!type) return report(value, path, show(value), "an object with a GeoJSON type");
    const std::string& name = type->text();
    if (name == "FeatureCollection") return each(value, path, "features");
    if (name == "GeometryCollection") return each(value, path, "geometries");
    if (name == "Feature") return read_feature(value, path);
    const JsonValue* coordinates = value.find("coordinates", JsonKind::kArray);
    if (!coordinates) return report(value, path, "no coordinates", "a list");
    if (name == "Polygon") return read_polygon(*coordinates, path + ".coordinates");
    if (name == "MultiPolygon") {
      for (std::size_t i = 0; i < coordinates->items().size(); ++i) {
        read_polygon(coordinates->items()[i], fmt::format("{}.coordinates[{}]", path, i));
      }
      return;
    }
    report(*type, path + ".type", show(*type),
           "Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection");
  }

  /// Whether the features' area_m2 are those of their coordinates: then these are metres, however small.
  bool has_own_areas() const {
    return own_area_ > 0 && std::abs(own_area_ - evidence_.area) <= 1e-3 * evidence_.area;
  }

  GeojsonFloes take() {
    floes.near_misses = near_misses_.found();
    return std::move(floes);
  }

  GeojsonFloes floes;

 private:
  void report(const JsonValue& value, const std::string& path, std::string found, std::string allowed) {
    problems_.report(source_, value.offset, path, std::move(found), std::move(allowed));
  }

  void each(const JsonValue& value, const std::string& path, std::string_view key) {
    const JsonValue* list = value.find(key, JsonKind::kArray);
    if (!list) return report(value, path, fmt::format("no {}", key), "a list of them");
    for (std::size_t i = 0; i < list->items().size(); ++i) {
      read(list->items()[i], fmt::format("{}{}{}[{}]", path, path.empty() ? "" : ".", key, i));
    }
  }

  void read_feature(const JsonValue& value, const std::string& path) {
    const JsonValue* geometry = value.find("geometry");
    const JsonValue* properties = value.find("properties");
    const JsonValue* area = properties ? properties->find("area_m2", JsonKind::kNumber) : nullptr;
    if (area) own_area_ += area->number();
    properties_ = properties ? read_properties(*properties, path + ".properties") : FloeProperties{};
    if (!geometry || geometry->is_null())
      return report(value, path, "a feature without geometry", "a Polygon or MultiPolygon");
    const std::size_t before = floes.polygons.size();
    read(*geometry, path + ".geometry");
    if (properties) near_misses_.add(*properties, properties_, floes.polygons.size() - before);
    properties_ = {};
  }

  FloeProperties read_properties(const JsonValue& properties, const std::string& path) {
    std::vector<BadProperty> bad;
    FloeProperties read = read_floe_properties(properties, names_, bad);
    for (BadProperty& one : bad)
      report(*one.value, fmt::format("{}.{}", path, one.key), std::move(one.found), std::move(one.allowed));
    return read;
  }

  void read_polygon(const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kArray) || value.items().empty())
      return report(value, path, show(value), "a list of rings");
    geometry::Polygon polygon;
    for (const JsonValue& item : value.items()) {
      auto ring = read_ring(item, path);
      if (!ring) return;
      (&item == &value.items().front() ? polygon.outer : polygon.holes.emplace_back()) = std::move(*ring);
    }
    evidence_.add(polygon);
    floes.polygons.push_back({std::move(polygon), properties_, value.offset});
  }

  std::optional<geometry::Ring> read_ring(const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kArray) || value.items().size() < 4) {
      report(value, path, show(value), "a ring: four or more [x, y], the last one equal to the first");
      return std::nullopt;
    }
    geometry::Ring ring;
    for (const JsonValue& item : value.items()) {
      const auto point = read_position(item, path);
      if (!point) return std::nullopt;
      ring.push_back(*point);
    }
    return ring;
  }

  std::optional<geometry::Point> read_position(const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kArray) || value.items().size() < 2 || value.items().size() > 3) {
      report(value, path, show(value), "[x, y]");
      return std::nullopt;
    }
    for (const JsonValue& item : value.items()) {
      if (item.is(JsonKind::kNumber)) continue;
      report(item, path, show(item), "a coordinate [m]");
      return std::nullopt;
    }
    return geometry::Point{value.items()[0].number(), value.items()[1].number()};
  }

  std::size_t source_;
  const PropertyNames& names_;
  ProblemCollector& problems_;
  NearMisses near_misses_;
  CoordinateEvidence evidence_;
  double own_area_ = 0;        ///< Σ of the features' area_m2 [m²]
  FloeProperties properties_;  ///< of the feature at hand
};

/// A run writes its time beside the floes, and when each was born.
std::optional<double> run_time_of(const JsonValue& root) {
  const JsonValue* time = root.find("t_s", JsonKind::kNumber);
  const JsonValue* features = root.find("features", JsonKind::kArray);
  if (!time || !features) return std::nullopt;
  for (const JsonValue& feature : features->items()) {
    const JsonValue* properties = feature.find("properties");
    if (!properties || !properties->find("floe_id") || !properties->find("born_s")) return std::nullopt;
  }
  return time->number();
}

}  // namespace

GeojsonFloes read_geojson(std::size_t source, const PropertyNames& names, ProblemCollector& problems) {
  const JsonDocument document = parse_json(problems.source(source).text);
  problems.add_faults(source, document.faults);
  if (!document.faults.empty()) return {};
  GeojsonReader reader(source, names, problems);
  reader.read(document.root, "");
  reader.floes.are_metres = reader.has_own_areas();
  reader.floes.run_time = run_time_of(document.root);
  if (const JsonValue* crs = document.root.find("crs")) {
    reader.floes.crs = crs_name(*crs);
    reader.floes.crs_offset = crs->offset;
  }
  return reader.take();
}

}  // namespace polynya::io
