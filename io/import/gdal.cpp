#include "io/import/gdal.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <limits>
#include <numbers>
#include <set>
#include <span>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/text/child_process.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using JsonKind = JsonValue::Kind;

constexpr std::string_view kNeedsGdal = "this needs GDAL's programs";
constexpr std::size_t kLongestAnswer = std::size_t{2} << 30;  ///< longest output of a program [bytes]

/// Returns GDAL's reason for a failure from its output: the first line that is one, without the list of drivers it
/// tried.
std::string reason_in(std::string_view text) {
  std::string_view reason = text.substr(0, text.find('\n'));
  bool is_found = false;
  for_pieces(text, '\n', [&](std::string_view line, std::size_t) {
    if (is_found || !(line.starts_with("ERROR") || line.starts_with("Unable"))) return;
    reason = line.substr(0, line.find(" with the following"));
    is_found = true;
  });
  return std::string(reason);
}

/// Runs a program of GDAL. Returns its output, or the reason why it failed.
Result<std::string> run_gdal(const std::vector<std::string>& words, std::string_view input = {},
                             std::size_t longest = kLongestAnswer) {
  auto output = run_child(words, longest, input);
  if (!output && output.error().is_missing)
    return fail(
        fmt::format("{} (ogr2ogr, gdaltransform and others), which are not there ({}): apt-get install gdal-bin",
                    kNeedsGdal, output.error().words));
  if (!output) return fail(std::move(output.error().words));
  if (output->code == 0) return std::move(output->out);
  const std::string reason = reason_in(output->err);
  return fail(reason.empty() ? fmt::format("{} ended with code {}", words[0], output->code) : reason);
}

// ---- coordinate systems

/// Returns true if GDAL would open a file or a web address to find the system, or would take the text for an option.
/// Such a definition is refused, because the text may come from somebody else's file.
bool leads_elsewhere(const std::string& definition) {
  constexpr std::string_view kOfOgc = "opengis.net/def/crs/";
  if (definition.empty() || definition.front() == '-' || definition.front() == '@') return true;
  if (definition.find("://") != std::string::npos && definition.find(kOfOgc) == std::string::npos) return true;
  std::error_code error;
  return std::filesystem::exists(definition, error);
}

/// Returns the horizontal part of a system that also has a height or a transformation to another datum.
const JsonValue& horizontal_part(const JsonValue& crs) {
  const JsonValue* part = nullptr;
  if (const JsonValue* components = crs.find("components", JsonKind::kArray);
      components && !components->items().empty())
    part = &components->items().front();
  if (crs.has("type", "BoundCRS")) part = crs.find("source_crs");
  return part ? horizontal_part(*part) : crs;
}

/// Returns the size of the unit of a system's first axis in SI units; 0 if it is not stated.
double unit_of(const JsonValue& crs) {
  constexpr double kDegree = std::numbers::pi / 180;
  const JsonValue* coordinates = crs.find("coordinate_system");
  const JsonValue* axes = coordinates ? coordinates->find("axis", JsonKind::kArray) : nullptr;
  const JsonValue* unit = axes && !axes->items().empty() ? axes->items().front().find("unit") : nullptr;
  if (!unit) return 0;
  if (unit->is(JsonKind::kText)) return unit->text() == "metre" ? 1 : unit->text() == "degree" ? kDegree : 0;
  const JsonValue* factor = unit->find("conversion_factor", JsonKind::kNumber);
  return factor ? factor->number() : 0;
}

bool are_near(double a, double b) {
  return std::abs(a - b) <= 1e-9 * std::abs(b);
}

Result<std::string> describe_crs(const std::string& definition) {
  return run_gdal({"gdalsrsinfo", "-o", "PROJJSON", definition});
}

}  // namespace

std::string name_of_system(const std::string& definition) {
  const std::size_t open = definition.find("[\"");
  if (open == std::string::npos) return shortened(definition, 100);
  return definition.substr(open + 2, definition.find('"', open + 2) - open - 2);
}

Result<Crs> find_crs(const std::string& definition) {
  const auto unknown = [&] {
    return fail(fmt::format("PROJ knows no coordinate system \"{}\", allowed: EPSG:n, OGC:CRS84, a PROJ string, WKT",
                            name_of_system(definition)));
  };
  if (leads_elsewhere(definition)) return unknown();
  auto text = describe_crs(definition);
  if (!text && text.error().starts_with(kNeedsGdal)) return fail(text.error());
  if (!text) return unknown();
  const JsonDocument document = parse_json(*text);
  const JsonValue& crs = horizontal_part(document.root);
  Crs found;
  if (const JsonValue* name = document.root.find("name", JsonKind::kText)) found.name = name->text();
  if (const JsonValue* id = document.root.find("id"); id && id->find("code", JsonKind::kNumber))
    if (const JsonValue* authority = id->find("authority", JsonKind::kText))
      found.code = fmt::format("{}:{}", authority->text(), id->find("code")->number());
  const JsonValue* type = crs.find("type", JsonKind::kText);
  if (!type) return unknown();
  found.is_geographic = type->text() == "GeographicCRS" && are_near(unit_of(crs), std::numbers::pi / 180);
  found.is_projected = type->text() == "ProjectedCRS" || type->text() == "EngineeringCRS";
  found.is_metric = found.is_projected && are_near(unit_of(crs), 1);
  return found;
}

// ---- projection

namespace {

constexpr Point kNowhere{std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::quiet_NaN()};

/// Returns the point in a line of gdaltransform, "x y"; NaN for "transformation failed."
Point point_in(std::string_view line) {
  Point p = kNowhere;
  const char* const end = line.data() + line.size();
  const auto [after_x, wrong_x] = std::from_chars(line.data(), end, p.x);
  if (wrong_x != std::errc() || after_x == end) return kNowhere;
  const auto [after_y, wrong_y] = std::from_chars(after_x + 1, end, p.y);
  return wrong_y == std::errc() && is_finite(p) ? p : kNowhere;
}

}  // namespace

Result<std::vector<Point>> transform(const std::vector<Point>& points, const std::string& from, const std::string& to) {
  std::string lines;
  for (const Point p : points) {
    if (!is_finite(p)) continue;
    append_number(lines, p.x);
    lines += ' ';
    append_number(lines, p.y);
    lines += '\n';
  }
  std::vector<Point> images(points.size(), kNowhere);
  if (lines.empty()) return images;
  const auto answer = run_gdal({"gdaltransform", "-s_srs", from, "-t_srs", to, "-output_xy"}, lines);
  if (!answer) return fail(answer.error());
  std::size_t next = 0;
  const auto skip_others = [&] {
    while (next < points.size() && !is_finite(points[next])) ++next;
  };
  for_pieces(*answer, '\n', [&](std::string_view line, std::size_t) {
    skip_others();
    if (next < images.size()) images[next] = point_in(line);
    ++next;
  });
  skip_others();
  if (next != points.size())
    return fail(fmt::format("gdaltransform gave other than one answer for each of {} points", points.size()));
  return images;
}

// ---- formats

namespace {

/// Kind of a file, from its beginning.
enum class FileKind {
  kOwn,      ///< GeoJSON, NDJSON or WKT, or something that cannot be opened
  kForeign,  ///< certainly none of these
  kUnknown,  ///< a text that does not begin as any of these
};

/// Returns true for a JSON format that is not GeoJSON: TopoJSON or that of Esri.
bool is_other_json(std::string_view begin) {
  return begin.find("\"Topology\"") != std::string_view::npos || begin.find("\"esriGeometry") != std::string_view::npos;
}

FileKind kind_of(const std::filesystem::path& file) {
  std::error_code error;
  if (std::filesystem::is_directory(file, error)) return FileKind::kForeign;
  if (!std::filesystem::is_regular_file(file, error))
    return FileKind::kOwn;  // opening a pipe would wait for its writer
  std::FILE* const stream = std::fopen(file.string().c_str(), "rb");
  if (!stream) return FileKind::kOwn;
  std::array<char, 4096> bytes{};
  const std::size_t count = std::fread(bytes.data(), 1, bytes.size(), stream);
  std::fclose(stream);
  std::string_view begin(bytes.data(), count);
  if (begin.find('\0') != std::string_view::npos) return FileKind::kForeign;
  if (begin.starts_with("\xEF\xBB\xBF")) begin.remove_prefix(3);
  const std::string_view words = trimmed(begin);
  if (words.starts_with('<')) return FileKind::kForeign;
  if (words.starts_with('{')) return is_other_json(words) ? FileKind::kForeign : FileKind::kOwn;
  return may_be_floe_text(words) ? FileKind::kOwn : FileKind::kUnknown;
}

/// Returns the name by which GDAL opens the file. It is absolute, because GDAL takes some relative names for databases;
/// for an archive it leads to the file inside.
std::string name_for_gdal(const std::filesystem::path& file) {
  const std::string name = std::filesystem::absolute(file).string();
  return file.extension() == ".zip" || file.extension() == ".ZIP" ? "/vsizip/" + name : name;
}

struct ForeignLayer {
  std::string name;
  std::string geometry;  ///< kind of its geometries, "Multi Polygon"
  std::string features;  ///< number of features
  std::string system;    ///< WKT; may be empty
};

/// Returns the layers from the output of `ogrinfo -so -al`.
std::vector<ForeignLayer> layers_in(std::string_view text) {
  std::vector<ForeignLayer> layers;
  bool is_in_system = false;
  for_pieces(text, '\n', [&](std::string_view line, std::size_t) {
    const auto value_of = [&](std::string_view key) {
      return line.starts_with(key) ? std::optional(std::string(line.substr(key.size()))) : std::nullopt;
    };
    if (auto name = value_of("Layer name: ")) layers.push_back({*std::move(name), "", "", ""});
    if (layers.empty()) return;
    ForeignLayer& layer = layers.back();
    if (auto geometry = value_of("Geometry: ")) layer.geometry = *std::move(geometry);
    if (auto features = value_of("Feature Count: ")) layer.features = *std::move(features);
    if (line.starts_with("Data axis")) is_in_system = false;
    if (is_in_system && line != "(unknown)") layer.system += std::string(line) + '\n';
    if (line == "Layer SRS WKT:") is_in_system = true;
    if (line == "(unknown)") is_in_system = false;
  });
  // GDAL gives GeoPackages without a system one with such a name.
  for (ForeignLayer& layer : layers)
    if (name_of_system(layer.system).starts_with("Undefined ")) layer.system.clear();
  return layers;
}

/// Returns true if the geometries of a layer may be polygons.
bool may_have_polygons(const ForeignLayer& layer) {
  constexpr std::string_view kOthers[] = {"None", "Point", "Line String", "Multi Point", "Multi Line String"};
  std::string_view type = layer.geometry;
  for (const std::string_view prefix : {"3D ", "Measured ", "3D Measured "})
    if (type.starts_with(prefix)) type.remove_prefix(prefix.size());
  return std::ranges::find(kOthers, type) == std::end(kOthers);
}

/// "ice (Polygon, 4 features), water (Polygon, 1 feature)"
std::string in_words(const std::vector<ForeignLayer>& layers) {
  std::vector<std::string> words;
  for (const ForeignLayer& layer : layers)
    words.push_back(fmt::format("{} ({}, {} feature{})", layer.name, layer.geometry, layer.features,
                                layer.features == "1" ? "" : "s"));
  return fmt::format("{}", fmt::join(words, ", "));
}

/// Returns the selected layer of the file, or fails with a message that lists its layers.
Result<ForeignLayer> choose(const std::vector<ForeignLayer>& layers, const Selection& selection) {
  const std::string& wanted = selection.layer;
  if (layers.empty()) return fail("it has no layer");
  std::vector<ForeignLayer> candidates;
  for (const ForeignLayer& layer : layers) {
    if (!wanted.empty() && layer.name == wanted) return layer;
    if (may_have_polygons(layer)) candidates.push_back(layer);
  }
  std::vector<std::string_view> names;
  for (const ForeignLayer& layer : layers) names.push_back(layer.name);
  if (!wanted.empty()) {
    const std::string meant = nearest(wanted, names);
    return fail(fmt::format("it has no layer \"{}\"{}; its layers: {}", wanted,
                            meant.empty() ? "" : fmt::format(", did you mean \"{}\"?", meant), in_words(layers)));
  }
  if (candidates.empty()) return fail(fmt::format("it has no layer with polygons; its layers: {}", in_words(layers)));
  if (candidates.size() > 1)
    return fail(fmt::format("it has several layers: {}; {} chooses one", in_words(layers), selection.layer_in_words));
  return candidates.front();
}

std::size_t feature_count(std::string_view geojson) {
  std::size_t count = 0;
  for_pieces(geojson, '\n', [&](std::string_view line, std::size_t) {
    count += line.starts_with("{ \"type\": \"Feature\",") ? 1 : 0;
  });
  return count;
}

std::string taken_in_words(const std::string& where, std::size_t taken, std::string_view all) {
  return fmt::format("{} of {} features were taken, where {}", taken, all, where);
}

/// Converts the features of a layer to GeoJSON in the file's coordinates.
Result<ForeignFile> convert(const std::string& name, const ForeignLayer& layer, const Selection& selection,
                            std::size_t longest) {
  std::vector<std::string> words{
      "ogr2ogr", "-f",   "GeoJSON",          "-lco", "RFC7946=NO", "-lco", "COORDINATE_PRECISION=15", "-dim",
      "XY",      "-nlt", "CONVERT_TO_LINEAR"};
  if (!selection.where.empty()) words.insert(words.end(), {"-where", selection.where});
  words.insert(words.end(), {"/vsistdout/", name, layer.name});
  auto geojson = run_gdal(words, {}, longest);
  if (!geojson) return fail(geojson.error());
  ForeignFile read{*std::move(geojson), layer.system, {}};
  if (!selection.where.empty())
    read.notes.push_back(taken_in_words(selection.where, feature_count(read.geojson), layer.features));
  return read;
}

}  // namespace

std::optional<Result<ForeignFile>> read_foreign_file(const std::filesystem::path& file, const Selection& selection,
                                                     std::size_t longest) {
  const FileKind kind = kind_of(file);
  if (kind == FileKind::kOwn) return {};
  const std::string name = name_for_gdal(file);
  const auto text = run_gdal({"ogrinfo", "-ro", "-so", "-al", name});
  if (!text && kind == FileKind::kUnknown) return {};
  if (!text) return fail("GDAL could not read it: " + text.error());
  const std::vector<ForeignLayer> layers = layers_in(*text);
  if (layers.empty() && kind == FileKind::kUnknown) return {};
  const auto layer = choose(layers, selection);
  if (!layer) return fail(layer.error());
  auto read = convert(name, *layer, selection, longest);
  if (!read) return fail("GDAL could not read it: " + read.error());
  if (layer->geometry.starts_with("3D")) read->notes.emplace_back("third coordinates are ignored");
  if (selection.layer.empty() && layers.size() > 1)
    read->notes.push_back(fmt::format("the layer \"{}\" was taken; its layers: {}", layer->name, in_words(layers)));
  return read;
}

// ---- selection

namespace {

/// Property with the number of a feature in the text for ogr2ogr.
constexpr std::string_view kFeatureNumber = "polynya_feature";

/// Returns the features of a text for ogr2ogr, by their numbers, each with the properties and the polygon of its first
/// entry.
std::string features_of(const FloeText& floes, std::set<std::size_t>& features) {
  return json_object([&](JsonWriter& json) {
    json.key("type").value("FeatureCollection").key("features").open('[');
    for (const FloeEntry& entry : floes.entries) {
      if (entry.refusal == "syntax" || !features.insert(entry.feature).second) continue;
      json.start_line();
      json.open('{').key("type").value("Feature").key("properties").open('{');
      json.key(kFeatureNumber).value(entry.feature);
      for (const auto* properties : {&entry.own_properties, &entry.properties})
        if (*properties) json.json(**properties);
      json.close('}').key("geometry").json("null").close('}');
    }
    json.close(']');
  });
}

}  // namespace

Result<std::string> select_features(FloeText& floes, const std::string& where) {
  if (floes.format == FloeFormat::kWkt) return fail("WKT has no properties by which features are selected");
  std::set<std::size_t> features;
  const std::string text = features_of(floes, features);
  if (features.empty()) return taken_in_words(where, 0, "0");
  const auto rows = run_gdal(
      {"ogr2ogr", "-f", "CSV", "/vsistdout/", "/vsistdin/", "-select", std::string(kFeatureNumber), "-where", where},
      text);
  if (!rows) return fail(rows.error());
  std::set<std::size_t> taken;
  for_pieces(*rows, '\n', [&](std::string_view line, std::size_t) {
    std::size_t row = 0;
    if (line.starts_with('"')) line.remove_prefix(1);
    if (std::from_chars(line.data(), line.data() + line.size(), row).ec == std::errc()) taken.insert(row);
  });
  std::erase_if(floes.entries, [&](const FloeEntry& entry) {
    return features.contains(entry.feature) && !taken.contains(entry.feature);
  });
  return taken_in_words(where, taken.size(), std::to_string(features.size()));
}

}  // namespace polynya::io
