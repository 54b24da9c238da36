#include "io/scene/floe_file.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "io/import/foreign_file.hpp"
#include "io/scene/floe_group.hpp"
#include "io/scene/geojson_reader.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

std::string origin_in_scene(double latitude, double longitude) {
  return fmt::format(R"("origin": {{"latitude_deg": {:.6g}, "longitude_deg": {:.6g}}} in the scene)",
                     latitude, longitude);
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

  PlaneSettings plane_of(const GeojsonFloes& floes,
                         const std::optional<simulation::GeographicOrigin>& origin) const {
    PlaneSettings plane = import_.settings.plane;
    if (plane.target.empty()) plane.origin = origin;
    plane.are_metres = floes.are_metres;
    plane.origin_in_words = origin_in_scene;
    plane.shift_in_words =
        R"("import": {"shift": true} beside "file" moves them to the middle of the plane, )"
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
        result_.floes.push_back({in_house_notation(std::move(sources[i].polygon)), sources[i].properties,
                                 floes.polygons[i].offset});
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

std::optional<FloeFile> read_floe_file(const std::filesystem::path& file,
                                       const std::optional<FileImport>& import,
                                       const std::optional<simulation::GeographicOrigin>& origin,
                                       const std::string& path, std::uint32_t offset,
                                       ProblemCollector& problems) {
  return FloeFileReader(import, path, offset, problems).read(file, origin);
}

}  // namespace polynya::io
