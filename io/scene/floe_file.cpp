#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "io/import/floe_import.hpp"
#include "io/scene/floe_list_reader.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {
namespace {

std::string origin_in_scene(double latitude, double longitude) {
  return fmt::format(R"("origin": {{"latitude_deg": {:.6g}, "longitude_deg": {:.6g}}} in the scene)", latitude,
                     longitude);
}

/// Words between commas.
std::vector<std::string_view> words_of(std::string_view text) {
  std::vector<std::string_view> words;
  for_pieces(text, ',', [&words](std::string_view piece, std::size_t) {
    if (const auto word = trimmed(piece); !word.empty()) words.push_back(word);
  });
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
    for (const std::string_view words : words_of(import_.properties))
      if (auto added = add_property_name(words, names); !added)
        report_entry(added.error(), "KEY=NAME, as thickness_m=THICK or thickness_m=CM*0.01");
    auto read = read_floe_text(problems_.source(result_.source).text);
    if (!read) report_entry(fmt::format("\"{}\":{}", file.string(), read.error()), "a floe file (docs/import.md)");
    if (problems_.count() > before) return {};
    text_ = *std::move(read);
    FloesOfText floes = floes_of(text_, names);
    result_.report = {.run_time = floes.run_time, .near_misses = std::move(floes.near_misses), .offset = offset_};
    place(floes.floes, plane_of(origin));
    if (problems_.count() > before) return {};
    return std::move(result_);
  }

 private:
  Result<std::string> text_of(const std::filesystem::path& file) const {
    auto foreign = read_foreign_file(file, import_.layer, kLongestFloesFile);
    return foreign ? *std::move(foreign) : read_text_file(file, kLongestFloesFile);
  }

  /// Where the features' area_m2 are those of their coordinates, these are metres, however small.
  bool are_metres() const {
    CoordinateEvidence evidence;
    for (const FloeEntry& entry : text_.entries) evidence.add(entry.polygon);
    return text_.stated_area > 0 && std::abs(text_.stated_area - evidence.area) <= 1e-3 * evidence.area;
  }

  PlaneSettings plane_of(const std::optional<simulation::GeographicOrigin>& origin) const {
    PlaneSettings plane = import_.settings.plane;
    if (plane.target.empty()) plane.origin = origin;
    plane.are_metres = are_metres();
    plane.origin_in_words = origin_in_scene;
    plane.shift_in_words = R"("import": {"shift": true} beside "file" moves them to the middle of the plane, )"
                           "an origin in the scene projects them about a place";
    plane.source_in_words = R"("import": {"from": "EPSG:n"} beside "file" names it)";
    return plane;
  }

  void place(std::vector<SourceFloe>& floes, PlaneSettings plane) {
    const std::string crs = crs_name(text_.crs);
    const auto offset_of = [&](std::size_t floe) { return text_.entries[floe].offset; };
    if (!is_imported_) {
      auto placed = bring_to_plane(floes, crs, plane);
      if (!placed) return report(placed.error());
      for (std::size_t i = 0; i < floes.size(); ++i) {
        if (!floes[i].refused.empty()) report({i, floes[i].refused});
        result_.floes.push_back({in_house_notation(std::move(floes[i].polygon)), floes[i].properties, offset_of(i)});
      }
      result_.report.plane = std::move(*placed);
      return;
    }
    ImportSettings settings = import_.settings;
    settings.plane = std::move(plane);
    auto imported = import_floes(floes, crs, settings);
    if (!imported) return report(imported.error());
    for (const ImportItem& item : imported->items) {
      if (item.refused.empty()) continue;
      report({item.source, item.refused + (item.is_outline_refused ? R"(; "repair": "non-zero" in its "import")"
                                                                     " makes a valid polygon of it"
                                                                   : "")});
    }
    result_.report.plane = std::move(imported->plane);
    result_.report.totals = imported->totals;
    for (ImportedFloe& floe : imported->floes)
      result_.floes.push_back({std::move(floe.polygon), floes[floe.source].properties, offset_of(floe.source)});
  }

  void report(const PlaneError& error) {
    const std::uint32_t offset = error.floe ? text_.entries[*error.floe].offset : 0;
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
  FloeText text_;
  FloeFile result_;
};

}  // namespace

std::optional<FloeFile> read_floe_file(const std::filesystem::path& file, const std::optional<FileImport>& import,
                                       const std::optional<simulation::GeographicOrigin>& origin,
                                       const std::string& path, std::uint32_t offset, ProblemCollector& problems) {
  return FloeFileReader(import, path, offset, problems).read(file, origin);
}

}  // namespace polynya::io
