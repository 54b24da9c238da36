#include "io/scene/floe_file.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/import/foreign_file.hpp"
#include "io/scene/floe_list_reader.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/degrees.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

struct GeojsonPolygon {
  geometry::Polygon polygon;  ///< rings as drawn, not checked for validity
  FloeProperties properties;  ///< of its feature
  std::uint32_t offset = 0;   ///< of its coordinates in the text
};

struct GeojsonFloes {
  std::vector<GeojsonPolygon> polygons;
  std::optional<double> run_time;  ///< where the floes are those of a run at that time [s]
  std::string crs;                 ///< the system that the text names; empty: none
  std::uint32_t crs_offset = 0;    ///< of it in the text
  std::vector<NearMiss> near_misses;
  bool are_metres = false;  ///< the features' area_m2 are those of their coordinates
};

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
    report(*type, path + ".type", show(*type), "Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection");
  }

  /// Whether the features' area_m2 are those of their coordinates: then these are metres, however small.
  bool has_own_areas() const { return own_area_ > 0 && std::abs(own_area_ - evidence_.area) <= 1e-3 * evidence_.area; }

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

/// The polygons of a GeoJSON text (Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection), in
/// order, with their properties by these names. A third coordinate is passed over. Anything else is added as
/// a problem of that source of the collector.
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

std::string origin_in_scene(double latitude, double longitude) {
  return fmt::format(R"("origin": {{"latitude_deg": {:.6g}, "longitude_deg": {:.6g}}} in the scene)", latitude,
                     longitude);
}

/// Words between commas.
std::vector<std::string> words_of(const std::string& text) {
  std::vector<std::string> words;
  for (std::size_t start = 0; start < text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    const std::size_t first = text.find_first_not_of(' ', start);
    if (first < end) words.push_back(text.substr(first, text.find_last_not_of(' ', end - 1) - first + 1));
    start = end + 1;
  }
  return words;
}

/// Reads one file. One use.
class FloeFileReader {
 public:
  FloeFileReader(const std::optional<FileImport>& import, std::string path, std::uint32_t offset,
                 ProblemCollector& problems)
      : is_imported_(import.has_value()),
        import_(import.value_or(FileImport{})),
        path_(std::move(path)),
        offset_(offset),
        problems_(problems) {}

  std::optional<FloeFile> read(const std::filesystem::path& file,
                               const std::optional<simulation::GeographicOrigin>& origin) {
    const std::size_t before = problems_.count();
    if (origin && !import_.settings.plane.target.empty())
      report_entry("import.crs in a scene that has an origin", "one of the two: the scene has one plane");
    auto text = text_of(file);
    if (!text) {
      report_entry("\"" + file.string() + "\": " + text.error(),
                   fmt::format("a floe file of at most {} bytes", kLongestFloesFile));
      return {};
    }
    result_.source = problems_.add_source({file.string(), std::move(*text)});
    PropertyNames names;
    for (const std::string& words : words_of(import_.properties))
      if (auto added = add_property_name(words, names); !added)
        report_entry(added.error(), "KEY=NAME, as thickness_m=THICK or thickness_m=CM*0.01");
    const GeojsonFloes floes = read_geojson(result_.source, names, problems_);
    if (problems_.count() > before) return {};
    result_.run_time = floes.run_time;
    result_.near_misses = floes.near_misses;
    place(floes, plane_of(floes, origin));
    if (problems_.count() > before) return {};
    return std::move(result_);
  }

 private:
  Result<std::string> text_of(const std::filesystem::path& file) const {
    const auto format = foreign_format(file);
    return format ? read_foreign_file(file, *format, import_.layer, kLongestFloesFile)
                  : read_text_file(file, kLongestFloesFile);
  }

  PlaneSettings plane_of(const GeojsonFloes& floes, const std::optional<simulation::GeographicOrigin>& origin) const {
    PlaneSettings plane = import_.settings.plane;
    if (plane.target.empty()) plane.origin = origin;
    plane.are_metres = floes.are_metres;
    plane.origin_in_words = origin_in_scene;
    plane.shift_in_words = R"("import": {"shift": true} beside "file" moves them to the middle of the plane, )"
                           "an origin in the scene projects them about a place";
    plane.source_in_words = R"("import": {"from": "EPSG:n"} beside "file" names it)";
    return plane;
  }

  void place(const GeojsonFloes& floes, PlaneSettings plane) {
    std::vector<SourceFloe> sources;
    sources.reserve(floes.polygons.size());
    for (const GeojsonPolygon& one : floes.polygons) sources.push_back({one.polygon, one.properties});
    if (!is_imported_) {
      std::vector<std::string> refused(sources.size());
      auto placed = bring_to_plane(sources, refused, floes.crs, plane);
      if (!placed) return report(floes, placed.error());
      for (std::size_t i = 0; i < refused.size(); ++i)
        if (!refused[i].empty()) report(floes, {i, refused[i]});
      result_.plane = std::move(*placed);
      for (std::size_t i = 0; i < sources.size(); ++i)
        result_.floes.push_back(
            {in_house_notation(std::move(sources[i].polygon)), sources[i].properties, floes.polygons[i].offset});
      return;
    }
    ImportSettings settings = import_.settings;
    settings.plane = std::move(plane);
    auto imported = import_floes(sources, {}, floes.crs, settings);
    if (!imported) return report(floes, imported.error());
    for (const ImportItem& item : imported->items) {
      if (item.refused.empty()) continue;
      if (!item.is_outline_refused) {
        report(floes, {item.source, item.refused});
        continue;
      }
      problems_.report(result_.source, floes.polygons[item.source].offset,
                       fmt::format("{} (its floe {})", path_, item.source), item.refused,
                       R"(a valid polygon, or "repair": "non-zero" in its "import")");
    }
    result_.plane = std::move(imported->plane);
    result_.totals = imported->totals;
    for (ImportedFloe& floe : imported->floes)
      result_.floes.push_back(
          {std::move(floe.polygon), sources[floe.source].properties, floes.polygons[floe.source].offset});
  }

  void report(const GeojsonFloes& floes, const PlaneError& error) {
    const std::uint32_t offset = error.floe ? floes.polygons[*error.floe].offset : floes.crs_offset;
    const std::string path = error.floe ? fmt::format("{} (its floe {})", path_, *error.floe) : path_;
    problems_.add(result_.source, offset, {.path = path, .sentence = error.words});
  }

  void report_entry(std::string found, std::string allowed) {
    problems_.report(0, offset_, path_, std::move(found), std::move(allowed));
  }

  const bool is_imported_;
  const FileImport import_;
  std::string path_;
  std::uint32_t offset_;
  ProblemCollector& problems_;
  FloeFile result_;
};

}  // namespace

std::optional<FloeFile> read_floe_file(const std::filesystem::path& file, const std::optional<FileImport>& import,
                                       const std::optional<simulation::GeographicOrigin>& origin,
                                       const std::string& path, std::uint32_t offset, ProblemCollector& problems) {
  return FloeFileReader(import, path, offset, problems).read(file, origin);
}

}  // namespace polynya::io
