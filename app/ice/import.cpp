#include <cmath>
#include <filesystem>
#include <memory>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/floe_import.hpp"
#include "io/text/cut.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::app {
namespace {

constexpr std::size_t kMostReported = 20;  ///< messages about floes; the report has all

constexpr auto kImportExamples =
    "Examples:\n"
    "  polynya import svalbard.geojson --origin 78.2,15.6 --out floes.geojson    longitude, latitude\n"
    "  polynya import floes.shp --crs EPSG:3413 --shift --out floes.geojson      by GDAL's ogr2ogr\n"
    "  polynya import drawn.geojson --repair non-zero --simplify 0.5 --min-area 4 --gap 0.1 --out "
    "floes.geojson\n"
    "  polynya import floes.gpkg --layer ice --property thickness_m=CM*0.01 --out floes.geojson\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 4 some floes were refused (the others are written) or all of them, 5 "
    "input/output.\n";

struct ImportOptions {
  std::string file;    ///< or "-" for stdin
  std::string out;     ///< or "-" for stdout
  std::string report;  ///< empty: stdout, unless the floes go there
  std::string origin;  ///< "LAT,LON" or "LAT,LON,HEADING" [°]
  std::string layer;
  ProgressKind progress = ProgressKind::kAuto;
  std::vector<std::string> properties;
  io::ImportSettings settings;
};

std::string origin_option(double latitude, double longitude) {
  return fmt::format("--origin {:.6g},{:.6g}", latitude, longitude);
}

Outcome<std::optional<simulation::GeographicOrigin>> read_origin(const std::string& words) {
  if (words.empty()) return std::nullopt;
  const auto numbers = io::read_numbers(words, 2, 3);
  const auto is_angle = [](double degrees) { return std::abs(degrees) <= 360; };
  if (!numbers || std::abs(numbers->front()) > 90 || !std::ranges::all_of(*numbers, is_angle))
    return failure(kUsage, fmt::format("--origin {}: not LATITUDE,LONGITUDE or LATITUDE,LONGITUDE,HEADING in degrees; "
                                       "a latitude is from -90 to 90",
                                       words));
  const std::vector<double>& n = *numbers;
  return simulation::GeographicOrigin{n[0] * geometry::kRadiansPerDegree, n[1] * geometry::kRadiansPerDegree,
                                      (n.size() > 2 ? n[2] : 90) * geometry::kRadiansPerDegree};
}

Outcome<io::FloeText> read_floes(const ImportOptions& options, const std::string& name) {
  std::optional<io::Result<std::string>> foreign;
  if (options.file != "-") foreign = io::read_foreign_file(options.file, options.layer, io::kLongestFloeText);
  auto found = foreign ? *std::move(foreign) : read_input(options.file, io::kLongestFloeText);
  if (!found) return failure(kInputOutput, fmt::format("{}: {}", name, found.error()));
  auto floes = io::read_floe_text(std::move(*found));
  if (!floes) return failure(kInputOutput, fmt::format("{}:{}", name, floes.error()));
  if (floes->has_more_coordinates) print_err("note: {}: third coordinates are ignored\n", name);
  if (floes->has_other_crs) return failure(kRefused, fmt::format("{}: its crs members differ", name));
  return std::move(*floes);
}

void report_items(const std::string& name, const io::ImportOutcome& imported,
                  const std::vector<io::FloeEntry>& entries) {
  std::size_t reported = 0;
  for (const bool is_refused : {true, false}) {
    for (const io::ImportItem& item : imported.items) {
      const std::string words = item_in_words(item, entries);
      if (item.refused.empty() == is_refused || words.empty() || ++reported > kMostReported) continue;
      const io::FloeEntry& entry = entries[item.source];
      print_err("{}:{}: feature {}, polygon {}: {}\n", name, entry.line, entry.feature, entry.member, words);
    }
  }
  if (reported > kMostReported) print_err("polynya: {} more; the report has all\n", reported - kMostReported);
}

void report_totals(const std::string& name, const io::ImportOutcome& imported,
                   const std::vector<io::NearMiss>& near_misses) {
  const io::ImportTotals& totals = imported.totals;
  if (totals.read == 0) print_err("note: {}: no floes in it\n", name);
  print_err("polynya: {}: {}\npolynya: {}\npolynya: {}\n", name, plane_in_words(imported.plane),
            counts_in_words(totals), areas_in_words(totals));
  if (totals.written > 0) print_err("polynya: {}\n", io::thickness_in_words(totals.with_thickness, totals.written));
  for (const io::NearMiss& miss : near_misses) {
    if (miss.floes > 0)
      print_err("note: {}: property \"{}\" of {} is not read; did you mean {}? --property '{}' reads it\n", name,
                miss.key, counted(miss.floes, "floe"), miss.meant, as_property_name(miss));
  }
  if (std::ranges::any_of(imported.items, &io::ImportItem::is_outline_refused))
    print_err("polynya: --repair non-zero, or even-odd, makes valid polygons of crossing outlines\n");
}

/// Without `geojson` the report alone.
io::Result<> write_results(const ImportOptions& options, const std::optional<std::string>& geojson,
                           const std::string& report) {
  if (geojson)
    if (auto written = write_output(options.out, *geojson); !written) return written;
  if (!options.report.empty()) return write_output(options.report, report);
  return options.out == "-" ? io::Result<>{} : write_output("-", report);
}

Outcome<ExitCode> import_all(const ImportOptions& options) {
  if (options.out == options.report) return failure(kUsage, "--out and --report are one and the same");
  io::ImportSettings settings = options.settings;
  auto origin = read_origin(options.origin);
  if (!origin) return tl::unexpected(origin.error());
  if (*origin && !settings.plane.target.empty())
    return failure(kUsage, "--origin and --crs: the plane is either about a place or that of a system");
  settings.plane.origin = *origin;
  settings.plane.chooses_origin = true;
  settings.plane.keeps_metres = false;
  settings.plane.origin_in_words = origin_option;
  settings.plane.shift_in_words =
      "--shift moves the floes to the middle of the plane, --origin LAT,LON projects them about a place";
  settings.plane.source_in_words = "--from EPSG:n names it";
  io::PropertyNames names;
  for (const std::string& words : options.properties)
    if (auto added = io::add_property_name(words, names); !added)
      return failure(kUsage, "--property: " + added.error());
  const std::string name = input_name(options.file);
  const auto text = read_floes(options, name);
  if (!text) return tl::unexpected(text.error());
  const std::string crs = io::crs_name(text->crs);
  io::FloesOfText read = io::floes_of(*text, names);
  const auto imported = with_progress(options.progress, "projecting and taking apart",
                                      [&] { return import_floes(read.floes, crs, settings); });
  if (!imported) {
    std::string place = name;
    if (const auto floe = imported.error().floe) {
      const io::FloeEntry& entry = text->entries[*floe];
      place += fmt::format(":{}: feature {}, polygon {}", entry.line, entry.feature, entry.member);
    }
    return failure(kRefused, fmt::format("{}: {}; nothing was written", place, imported.error().words));
  }
  report_items(name, *imported, text->entries);
  const io::ImportTotals& totals = imported->totals;
  const bool are_all_refused = totals.refused > 0 && totals.refused == totals.read;
  std::optional<std::string> geojson;
  if (!are_all_refused) geojson = to_geojson(*imported, read.floes, text->entries);
  if (const auto written =
          write_results(options, geojson, to_json_text(*imported, name, text->entries, read.near_misses));
      !written)
    return failure(kInputOutput, written.error());
  report_totals(name, *imported, read.near_misses);
  if (are_all_refused) return failure(kRefused, name + ": every floe was refused; only the report was written");
  return totals.refused == 0 ? kDone : kRefused;
}

void add_plane_options(CommandLine& command, ImportOptions& options) {
  const OptionTraits traits{.group = "The plane"};
  command.option("--origin", &options.origin, "LAT,LON",
                 "Metres about this place [°], x to the east; a third number is the heading of x, as in a scene's "
                 "origin",
                 {}, traits);
  command.option("--crs", &options.settings.plane.target, "EPSG:n",
                 "The plane of this projected system instead; any name PROJ knows", not_empty(), traits);
  command.option("--from", &options.settings.plane.source, "EPSG:n", "The file's system, where the file names none",
                 not_empty(), traits);
  command.flag("--shift", options.settings.plane.is_shifted,
               "Move the middle of the floes' box to (0, 0), by whole metres", traits);
}

void add_floe_options(CommandLine& command, ImportOptions& options) {
  io::ImportSettings& settings = options.settings;
  command.choice<geometry::FillRule>(
      "--repair", settings.repair,
      "Make valid polygons of outlines that are not, exactly, by what the rule fills; else they are refused",
      {{"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}});
  command.option("--simplify", &settings.simplify, "M",
                 "Leave out vertices, each at most so far from the outline that is left [m]", between(0, 1e4));
  command.option("--min-area", &settings.least_area, "M2", "Drop smaller floes [m²]", between(0, 1e12));
  command.option("--gap", &settings.gap, "M", "Least distance between floes: the smaller of two is trimmed to it [m]",
                 between(0, 1e3));
  command.option("--layer", &options.layer, "NAME", "Of a GeoPackage with several", not_empty());
  command.option("--property", &options.properties, "KEY=NAME",
                 "The file's name for a property, with a factor for its unit: thickness_m=THICK, "
                 "thickness_m=CM*0.01; may be repeated",
                 {}, {.one_each_time = true});
}

}  // namespace

Command add_import(CommandLine& app) {
  CommandLine command =
      app.add_command("import", "Make a floe file of mapped ice: project, repair, part overlaps", kImportExamples);
  auto options = std::make_shared<ImportOptions>();
  command.option("file", &options->file, "FILE",
                 "GeoJSON, NDJSON or WKT, recognised by content; shapefile, GeoPackage or FlatGeobuf by ogr2ogr; - "
                 "for stdin",
                 {}, {.is_required = true});
  command.option("--out", &options->out, "FILE", "The floes, GeoJSON in metres; - for stdout", not_empty(),
                 {.is_required = true});
  command.option("--report", &options->report, "FILE",
                 "The report, JSON; stdout if not given, unless the floes go there");
  add_plane_options(command, *options);
  add_floe_options(command, *options);
  add_progress(command, options->progress);
  return {command, [options] { return code_of(import_all(*options)); }};
}

}  // namespace polynya::app
