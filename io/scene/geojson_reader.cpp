#include "io/scene/geojson_reader.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include <fmt/format.h>

#include "io/scene/floe_group.hpp"
#include "io/scene/floe_ice.hpp"
#include "io/scene/scene_resolve.hpp"
#include "io/text/degrees.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {
namespace {

using JsonKind = JsonValue::Kind;
constexpr double kLargestCoordinate = 1e6;  ///< [m]

class GeojsonReader {
 public:
  GeojsonReader(std::size_t source, ProblemCollector& problems) : source_(source), problems_(problems) {}

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

  /// What is wrong with the coordinates as a whole.
  void check_coordinates(const JsonValue& root) {
    const JsonValue* crs = root.find("crs");
    const std::string& name = problems_.source(source_).name;
    const std::string geographic = crs ? geographic_crs(*crs) : "";
    if (!geographic.empty()) {
      refuse_all(*crs, "crs",
                 fmt::format("longitude and latitude ({}): Polynya needs metres and does not project yet: {}",
                             geographic, how_to_project(evidence_.box, name)));
    } else if (large_count_ > 0) {
      const std::size_t others = large_count_ - 1;
      const std::string more =
          others > 0 ? fmt::format(", and as far in {} more ring{}", others, others == 1 ? "" : "s") : "";
      problems_.add(
          source_, large_offset_,
          {.path = large_path_,
           .found = large_ + more,
           .allowed = fmt::format("coordinates from {} to {} [m]: move the origin to the floes; ogr2ogr "
                                  "-t_srs \"+proj=aeqd +lat_0=LATITUDE +lon_0=LONGITUDE\" does",
                                  -kLargestCoordinate, kLargestCoordinate)});
    } else if (!crs && evidence_.look_like_degrees() && !has_own_areas()) {
      refuse_all(
          root, "",
          fmt::format(
              "these look like longitude and latitude, which GeoJSON without a crs member has [RFC 7946]: "
              "all within ±180, ±90, and as metres {:.4g} m² of ice in all; Polynya needs metres and does "
              "not project yet: {}; a crs member that names a projected system keeps them as metres",
              evidence_.area, how_to_project(evidence_.box, name)));
    } else {
      return;
    }
    floes.polygons.clear();
  }

  GeojsonFloes floes;

 private:
  void refuse_all(const JsonValue& value, const std::string& path, std::string sentence) {
    problems_.add(source_, value.offset, {.path = path, .sentence = std::move(sentence)});
  }

  /// Whether the features' area_m2 are those of their coordinates: then these are metres, however small.
  bool has_own_areas() const {
    return own_area_ > 0 && std::abs(own_area_ - evidence_.area) <= 1e-3 * evidence_.area;
  }

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
    if (!geometry || geometry->is_null())
      return report(value, path, "a feature without geometry", "a Polygon or MultiPolygon");
    if (properties) ice_ = read_given_ice(*properties, source_, path + ".properties", problems_);
    read(*geometry, path + ".geometry");
    ice_.clear();
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
    floes.polygons.push_back({in_house_notation(std::move(polygon)), value.offset, ice_});
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
      if (std::max(std::abs(point->x), std::abs(point->y)) > kLargestCoordinate) {
        add_large(item, *point, path);
        return std::nullopt;
      }
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

  void add_large(const JsonValue& value, geometry::Point point, const std::string& path) {
    if (large_count_++ > 0) return;
    large_offset_ = value.offset;
    large_path_ = path;
    large_ = fmt::format("[{}, {}]", point.x, point.y);
  }

  std::size_t source_;
  ProblemCollector& problems_;
  CoordinateEvidence evidence_;
  GivenIce ice_;         ///< of the feature at hand
  double own_area_ = 0;  ///< Σ of the features' area_m2 [m²]
  std::size_t large_count_ = 0;
  std::uint32_t large_offset_ = 0;  ///< of the first too large position, its path and itself
  std::string large_path_, large_;
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

GeojsonFloes read_geojson(std::size_t source, ProblemCollector& problems) {
  const JsonDocument document = parse_json(problems.source(source).text);
  problems.add_faults(source, document.faults);
  if (!document.faults.empty()) return {};
  GeojsonReader reader(source, problems);
  reader.read(document.root, "");
  reader.check_coordinates(document.root);
  reader.floes.run_time = run_time_of(document.root);
  return std::move(reader.floes);
}

}  // namespace polynya::io
