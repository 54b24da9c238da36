#include "io/geojson_reader.hpp"

#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/floe_group.hpp"
#include "io/json_parser.hpp"
#include "io/scene_resolve.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;
constexpr double kLargestCoordinate = 1e6;  ///< [m]

class GeojsonReader {
 public:
  GeojsonReader(std::size_t source, ProblemCollector& problems) : source_(source), problems_(problems) {}

  void read(const JsonValue& value, const std::string& path) {
    const JsonValue* type = value.find("type");
    if (!type || !type->is(JsonKind::kText))
      return tell(value, path, show(value), "an object with a GeoJSON type");
    const std::string& name = type->text();
    if (name == "FeatureCollection") return each(value, path, "features");
    if (name == "GeometryCollection") return each(value, path, "geometries");
    if (name == "Feature") return read_feature(value, path);
    const JsonValue* coordinates = value.find("coordinates");
    if (!coordinates || !coordinates->is(JsonKind::kArray))
      return tell(value, path, "no coordinates", "a list");
    if (name == "Polygon") return read_polygon(*coordinates, path + ".coordinates");
    if (name == "MultiPolygon") {
      for (std::size_t i = 0; i < coordinates->items().size(); ++i) {
        read_polygon(coordinates->items()[i], fmt::format("{}.coordinates[{}]", path, i));
      }
      return;
    }
    tell(*type, path + ".type", show(*type),
         "Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection");
  }

  std::vector<GeojsonPolygon> polygons;

 private:
  void tell(const JsonValue& value, const std::string& path, std::string found, std::string allowed) {
    problems_.add(source_, value.offset,
                  {.path = path, .found = std::move(found), .allowed = std::move(allowed)});
  }

  void each(const JsonValue& value, const std::string& path, std::string_view key) {
    const JsonValue* list = value.find(key);
    if (!list || !list->is(JsonKind::kArray))
      return tell(value, path, fmt::format("no {}", key), "a list of them");
    for (std::size_t i = 0; i < list->items().size(); ++i) {
      read(list->items()[i], fmt::format("{}{}{}[{}]", path, path.empty() ? "" : ".", key, i));
    }
  }

  void read_feature(const JsonValue& value, const std::string& path) {
    const JsonValue* geometry = value.find("geometry");
    if (!geometry || geometry->is_null())
      return tell(value, path, "a feature without geometry", "a Polygon or MultiPolygon");
    read(*geometry, path + ".geometry");
  }

  void read_polygon(const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kArray) || value.items().empty())
      return tell(value, path, show(value), "a list of rings");
    geometry::Polygon polygon;
    for (const JsonValue& item : value.items()) {
      auto ring = read_ring(item, path);
      if (!ring) return;
      (&item == &value.items().front() ? polygon.outer : polygon.holes.emplace_back()) = std::move(*ring);
    }
    polygons.push_back({in_house_notation(std::move(polygon)), value.offset});
  }

  std::optional<geometry::Ring> read_ring(const JsonValue& value, const std::string& path) {
    if (!value.is(JsonKind::kArray) || value.items().size() < 4) {
      tell(value, path, show(value), "a ring: four or more [x, y], the last one equal to the first");
      return std::nullopt;
    }
    geometry::Ring ring;
    for (const JsonValue& item : value.items()) {
      if (!is_position(item)) {
        tell(item, path, show(item),
             fmt::format("[x, y], each ≥ {} and ≤ {} [m]", -kLargestCoordinate, kLargestCoordinate));
        return std::nullopt;
      }
      ring.push_back({item.items()[0].number(), item.items()[1].number()});
    }
    return ring;
  }

  static bool is_position(const JsonValue& value) {
    if (!value.is(JsonKind::kArray) || value.items().size() < 2 || value.items().size() > 3) return false;
    for (const JsonValue& item : value.items()) {
      if (!item.is(JsonKind::kNumber) || !(std::abs(item.number()) <= kLargestCoordinate)) return false;
    }
    return true;
  }

  std::size_t source_;
  ProblemCollector& problems_;
};

}  // namespace

std::vector<GeojsonPolygon> read_geojson(std::size_t source, ProblemCollector& problems) {
  const JsonDocument document = parse_json(problems.source(source).text);
  for (const JsonFault& fault : document.faults) {
    problems.add(
        source, fault.offset,
        {.path = fault.path, .found = fault.found, .allowed = fault.allowed, .sentence = fault.sentence});
  }
  if (!document.faults.empty()) return {};
  GeojsonReader reader(source, problems);
  reader.read(document.root, "");
  return std::move(reader.polygons);
}

}  // namespace polynya::io
