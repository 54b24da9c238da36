#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <memory>
#include <tuple>
#include <utility>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "geometry/shape/angle.hpp"
#include "io/import/floe_import.hpp"
#include "io/import/gdal.hpp"
#include "io/import/plane.hpp"
#include "io/text/cut.hpp"
#include "io/text/floe_ids.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

// ---- polynya cut: reports on stderr

constexpr std::size_t kMostReported = 100;  ///< number of messages; the ledger has all
constexpr std::size_t kMostVertices = 4;    ///< number of vertices in a message; the ledger has all

/// Prints a line for each polygon that was refused or repaired and for each line that separates nothing, as
/// "floes.geojson:3: feature 1, polygon 0: …". Beyond kMostReported they are only counted.
void report_floes(const std::string& name, const io::CutReport& report) {
  std::size_t reported = 0;
  const auto report_of = [&](const io::CutFloe& floe, const std::string& words) {
    if (++reported > kMostReported) return;
    print_err("{}:{}: feature {}, polygon {}: {}\n", name, floe.line, floe.feature, floe.member, words);
  };
  for (const io::CutFloe& floe : report.floes) {
    if (floe.rejected) {
      std::string words = floe.rejected->reason;
      if (!floe.rejected->detail.empty()) words += ": " + floe.rejected->detail;
      const auto& vertices = floe.rejected->vertices;
      words += io::places_in_words(vertices, kMostVertices);
      if (vertices.size() > kMostVertices) words += fmt::format(" and {} more", vertices.size() - kMostVertices);
      report_of(floe, words);
    }
    if (floe.repair) {
      report_of(floe, fmt::format("{}, repaired ({}): {}, {:+} m2 to the {} m2 drawn", floe.repair->defect,
                                  floe.repair->rule, counted(floe.repair->shapes, "polygon"), floe.repair->area_changed,
                                  floe.repair->area_drawn));
    }
    if (floe.dangling_length > 0)
      report_of(floe, fmt::format("the line separates nothing over {:.6g} m of ice", floe.dangling_length));
  }
  if (reported > kMostReported) print_err("polynya: {} more; the ledger has all\n", reported - kMostReported);
}

void report_totals(const io::CutReport& report) {
  const io::CutTotals totals = io::totals_of(report);
  const auto floes = std::ranges::count_if(
      report.floes, [](const io::CutFloe& floe) { return !floe.rejected || !floe.pieces.empty(); });
  print_err("polynya: {} -> {}; {:.9g} m2 = {:.9g} in pieces + {:.9g} removed (exact defect {}, rounding {:.2e} m2)\n",
            counted(floes, "floe"), counted(totals.pieces, "piece"), totals.area, totals.area_of_pieces, totals.removed,
            totals.exact_defect, totals.rounding_defect);
  if (totals.snap_rounded > 0) {
    print_err("polynya: {} piece{} snap-rounded: nearest doubles did not make a valid polygon\n", totals.snap_rounded,
              totals.snap_rounded == 1 ? " was" : "s were");
  }
  if (totals.rejected > 0) {
    print_err("polynya: {} refused; {}\n", totals.rejected,
              totals.rejected == totals.floes ? "nothing was cut" : "the others were cut");
  }
}

/// Prints notes on properties of the text that the pieces do not have.
void report_losses(const std::string& name, const io::FloeText& floes, io::FloeFormat format) {
  const auto note = [&name](const char* words) { print_err("note: {}: {}\n", name, words); };
  if (floes.entries.empty()) note("no floes in it");
  if (floes.has_more_coordinates) note("third coordinates are ignored");
  if (floes.has_srid) note("SRID is ignored");
  if (floes.has_other_crs && !floes.crs.empty()) note("its crs members differ; the pieces get the first");
  if (!floes.place.wrong.empty()) note(floes.place.wrong.c_str());
  if (format != io::FloeFormat::kWkt) return;
  if (!floes.crs.empty()) note("WKT has no room for its crs");
  if (floes.place.is_stated()) note("WKT has no room for its origin");
  if (std::ranges::any_of(floes.entries, [](const io::FloeEntry& one) { return one.properties != nullptr; }))
    note("WKT has no room for properties");
}

// ---- polynya cut

constexpr std::size_t kLongestOps = std::size_t{64} << 20;  ///< [bytes]

constexpr auto kCutExamples =
    "Examples:\n"
    "  polynya cut floes.geojson --disc 10,5,3 --out pieces.geojson        ledger to stdout\n"
    "  polynya cut floes.wkt --crack 0,0,30 --out - --ledger ledger.json   pieces to stdout\n"
    "  polynya cut - --polygon channel.geojson --keep both --out pieces.ndjson < floes.ndjson\n"
    "  polynya cut floes.geojson --ops cuts.json --repair even-odd --out pieces.geojson\n"
    "\n"
    "Exit codes: 0 all were cut, 2 usage, 4 some polygons were refused (the others are cut), 5 input/output.\n";

struct CutOptions {
  std::string floes;                            ///< file, or "-" for stdin; the same holds for the other files
  std::string disc, crack, line, polygon, ops;  ///< only one of these is given; the others are empty
  io::Keep keep = io::Keep::kOutside;
  double sagitta = 0;          ///< [m]; 0: chosen from the radius
  std::optional<double> snap;  ///< [m]; none: chosen from the coordinates
  std::string out;             ///< empty: none, or stdout if the ledger is written to a file
  std::string ledger;          ///< empty: stdout, unless the pieces are written there
  std::optional<geometry::FillRule> repair;
};

tl::unexpected<ExitCode> failure(const std::string& where, const io::ToolError& error) {
  const bool is_invalid = error.kind == io::ToolError::Kind::kInvalidPolygon;
  return failure(is_invalid ? kRefused : kUsage, fmt::format("{}: {}", where, error.words));
}

Outcome<std::vector<io::CutOp>> one_op(const char* where, io::ToolOutcome<io::CutOp> op, io::Keep keep) {
  if (!op) return failure(where, op.error());
  op->keep = keep;
  return std::vector<io::CutOp>{std::move(*op)};
}

Outcome<std::vector<io::CutOp>> read_ops(const CutOptions& options) {
  const std::string* const tools[] = {&options.disc, &options.crack, &options.line, &options.polygon, &options.ops};
  const auto given = std::ranges::count_if(tools, [](const std::string* tool) { return !tool->empty(); });
  if (given != 1) {
    return failure(kUsage, fmt::format("one of --disc, --crack, --line, --polygon, --ops is needed, {} given",
                                       given == 0 ? "none is" : fmt::format("{} are", given)));
  }
  for (const auto& [option, text, count] : {std::tuple{"--disc", &options.disc, std::size_t{3}},
                                            {"--crack", &options.crack, std::size_t{3}},
                                            {"--line", &options.line, std::size_t{4}}}) {
    if (text->empty()) continue;
    const auto numbers = io::read_numbers(*text, count, count);
    if (!numbers) return failure(kUsage, fmt::format("{}: {}", option, numbers.error()));
    auto op = io::op_of_numbers(option + 2, *numbers, options.sagitta);
    if (auto* line = op ? std::get_if<io::LineTool>(&op->tool) : nullptr) line->snap = options.snap;
    return one_op(option, std::move(op), options.keep);
  }
  const std::string& file = options.polygon.empty() ? options.ops : options.polygon;
  auto text = read_input(file, options.polygon.empty() ? kLongestOps : io::kLongestFloeText);
  if (!text) return failure(kInputOutput, fmt::format("{}: {}", file, text.error()));
  if (!options.polygon.empty()) {
    const auto as_op = [](io::PolygonTool&& tool) { return io::CutOp{std::move(tool), {}}; };
    return one_op(file.c_str(), io::polygon_tool(std::move(*text)).map(as_op), options.keep);
  }
  auto ops = io::read_cut_ops(*text, {options.keep, options.sagitta, options.snap});
  if (!ops) return failure(file, ops.error());
  return *std::move(ops);
}

/// Returns the format for the extension of --out; none if it has no extension.
Outcome<std::optional<io::FloeFormat>> output_format(const std::string& file) {
  std::string extension = std::filesystem::path(file).extension().string();
  if (extension.empty()) return std::nullopt;
  std::ranges::transform(extension, extension.begin(),
                         [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c | 0x20) : c; });
  for (const auto& [ending, format] : {std::pair{".geojson", io::FloeFormat::kGeojson},
                                       {".json", io::FloeFormat::kGeojson},
                                       {".ndjson", io::FloeFormat::kNdjson},
                                       {".jsonl", io::FloeFormat::kNdjson},
                                       {".geojsonl", io::FloeFormat::kNdjson},
                                       {".wkt", io::FloeFormat::kWkt}}) {
    if (extension == ending) return format;
  }
  return failure(kUsage, fmt::format("--out {}: no format has the extension {}; GeoJSON: .geojson, .json; NDJSON: "
                                     ".ndjson, .jsonl, .geojsonl; WKT: .wkt (others: ogr2ogr converts GeoJSON)",
                                     file, extension));
}

/// Writes the pieces to --out, and the ledger to --ledger or else to stdout, unless the pieces are written there.
io::Result<> write_results(const CutOptions& options, const io::CutReport& report, io::FloeFormat format) {
  std::string ledger = options.ledger;
  std::string out = options.out;
  if (ledger.empty() && out != "-") ledger = "-";
  if (out.empty() && !ledger.empty() && ledger != "-") out = "-";
  if (!out.empty()) {
    if (auto written = write_output(out, to_floe_text(report, format)); !written) return written;
  } else {
    print_err("polynya: the ledger is on stdout; name --out FILE for the pieces, or --ledger FILE\n");
  }
  if (ledger.empty()) return {};
  return write_output(ledger, to_ledger_json(report));
}

/// Refuses coordinates in degrees, because they have no areas in m².
Outcome<void> check_units(const std::string& name, const io::FloeText& floes) {
  constexpr auto kRemedy = "polynya import makes metres of them";
  const std::string crs = io::crs_name(floes.crs);
  const auto known = crs.empty() ? io::fail("") : io::find_crs(crs);
  if (known && known->is_geographic)
    return failure(kRefused,
                   fmt::format("{}: crs: longitude and latitude ({}), areas would not be m2: {}", name, crs, kRemedy));
  io::CoordinateEvidence evidence;
  for (const io::FloeEntry& entry : floes.entries) evidence.add(entry.polygon);
  if (floes.crs.empty() && floes.format != io::FloeFormat::kWkt && evidence.look_polar())
    print_err("note: {}: these look like longitude and latitude; areas and lengths are then in degrees: {}\n", name,
              kRemedy);
  return {};
}

ExitCode cut_all(const CutOptions& options) {
  if (!options.out.empty() && options.out == options.ledger)
    return fail(kUsage, "--out and --ledger are one and the same");
  if (options.floes == "-" && (options.polygon == "-" || options.ops == "-"))
    return fail(kUsage, "stdin can be read once");
  const auto wanted_format = output_format(options.out);
  if (!wanted_format) return wanted_format.error();
  auto ops = read_ops(options);
  if (!ops) return ops.error();
  const std::string name = input_name(options.floes);
  auto text = read_input(options.floes, io::kLongestFloeText);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", name, text.error()));
  const auto floes = io::read_floe_text(std::move(*text));
  if (!floes) return fail(kInputOutput, fmt::format("{}:{}", name, floes.error()));
  if (const auto units = check_units(name, *floes); !units) return units.error();
  const io::FloeFormat format = wanted_format->value_or(floes->format);
  report_losses(name, *floes, format);
  io::CutReport report = cut_floes(floes->entries, std::move(*ops), options.repair);
  report.crs = floes->crs;
  report.place = floes->place;
  if (!report.ids_replaced.empty())
    print_err("note: {}: {}\n", name, io::replaced_in_words(report.ids_replaced, report.source_id_key));
  report_floes(name, report);
  if (const auto written = write_results(options, report, format); !written) return fail(kInputOutput, written.error());
  report_totals(report);
  return io::totals_of(report).rejected == 0 ? kDone : kRefused;
}

// ---- polynya import

constexpr std::size_t kMostItems = 20;  ///< number of messages about floes; the report has all

constexpr auto kImportExamples =
    "Examples:\n"
    "  polynya import svalbard.geojson --origin 78.2,15.6 --out floes.geojson    longitude, latitude\n"
    "  polynya import floes.shp --crs EPSG:3413 --shift --out floes.geojson      by GDAL's ogr2ogr\n"
    "  polynya import drawn.geojson --repair non-zero --simplify 0.5 --min-area 4 --gap 0.1 --out floes.geojson\n"
    "  polynya import floes.gpkg --layer ice --property thickness_m=CM*0.01 --out floes.geojson\n"
    "  polynya import chart.shp --where \"POLY_TYPE = 'I'\" --nodata -9 \\\n"
    "    --property \"thickness_m=SA[85:0.2 87:0.5 91:0.95 93:1.6]\" --out floes.geojson    an ice chart (SIGRID-3)\n"
    "\n"
    "Exit codes: 0 done, 2 usage, 4 some floes were refused (the others are written) or all of them, 5 input/output.\n";

struct ImportOptions {
  std::string file;     ///< file, or "-" for stdin
  std::string out;      ///< file, or "-" for stdout
  std::string report;   ///< empty: stdout, unless the floes are written there
  std::string origin;   ///< "LAT,LON" or "LAT,LON,HEADING" [°]
  std::string no_data;  ///< numbers, separated by commas, that mean "no value"
  io::Selection selection;
  ProgressKind progress = ProgressKind::kAuto;
  std::vector<std::string> properties;
  io::ImportSettings settings;
};

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

/// A floe file that was read.
struct FloeFile {
  io::FloeText text;
  io::FilePlace place;
  std::vector<std::string> notes;
};

Outcome<FloeFile> read_floes(const ImportOptions& options, const std::string& name) {
  std::optional<io::Result<io::ForeignFile>> foreign;
  if (options.file != "-") foreign = io::read_foreign_file(options.file, options.selection, io::kLongestFloeText);
  if (foreign && !*foreign) return failure(kInputOutput, fmt::format("{}: {}", name, foreign->error()));
  auto found = foreign ? std::move((*foreign)->geojson) : read_input(options.file, io::kLongestFloeText);
  if (!found) return failure(kInputOutput, fmt::format("{}: {}", name, found.error()));
  auto text = io::read_floe_text(std::move(*found));
  if (!text) return failure(kInputOutput, fmt::format("{}:{}", name, text.error()));
  FloeFile read{std::move(*text), {}, {}};
  if (read.text.has_more_coordinates) read.notes.emplace_back("third coordinates are ignored");
  if (read.text.has_other_crs) return failure(kRefused, fmt::format("{}: its crs members differ", name));
  read.place = {foreign ? (*foreign)->system : io::system_of(read.text), read.text.place};
  if (foreign) {
    std::ranges::copy((*foreign)->notes, std::back_inserter(read.notes));
    return read;
  }
  if (!options.selection.layer.empty())
    return failure(
        kUsage, fmt::format("{}: --layer {}: GeoJSON, NDJSON and WKT have no layers", name, options.selection.layer));
  if (!options.selection.where.empty()) {
    auto taken = io::select_features(read.text, options.selection.where);
    if (!taken) return failure(kInputOutput, fmt::format("{}: --where: {}", name, taken.error()));
    read.notes.push_back(std::move(*taken));
  }
  return read;
}

void report_items(const std::string& name, const io::ImportOutcome& imported,
                  const std::vector<io::FloeEntry>& entries) {
  std::size_t reported = 0;
  for (const bool is_refused : {true, false}) {
    for (const io::ImportItem& item : imported.items) {
      const std::string words = item_in_words(item, entries);
      if (item.refused.empty() == is_refused || words.empty() || ++reported > kMostItems) continue;
      const io::FloeEntry& entry = entries[item.source];
      print_err("{}:{}: feature {}, polygon {}: {}\n", name, entry.line, entry.feature, entry.member, words);
    }
  }
  if (reported > kMostItems) print_err("polynya: {} more; the report has all\n", reported - kMostItems);
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

/// Writes the floes and the report; only the report if there is no `geojson`.
io::Result<> write_results(const ImportOptions& options, const std::optional<std::string>& geojson,
                           const std::string& report) {
  if (geojson)
    if (auto written = write_output(options.out, *geojson); !written) return written;
  if (!options.report.empty()) return write_output(options.report, report);
  return options.out == "-" ? io::Result<>{} : write_output("-", report);
}

Outcome<io::PropertyRules> read_rules(const ImportOptions& options) {
  io::PropertyRules rules;
  for (const std::string& words : options.properties)
    if (auto added = io::add_property_name(words, rules.names); !added)
      return failure(kUsage, "--property: " + added.error());
  if (options.no_data.empty()) return rules;
  auto numbers = io::read_numbers(options.no_data, 1, 100);
  if (!numbers) return failure(kUsage, "--nodata: " + numbers.error());
  rules.no_data = std::move(*numbers);
  return rules;
}

ExitCode import_all(const ImportOptions& options) {
  if (options.out == options.report) return fail(kUsage, "--out and --report are one and the same");
  io::ImportSettings settings = options.settings;
  auto origin = read_origin(options.origin);
  if (!origin) return origin.error();
  if (*origin && !settings.plane.target.empty())
    return fail(kUsage, "--origin and --crs: the plane is either about a place or that of a system");
  settings.plane.origin = *origin;
  settings.plane.chooses_origin = true;
  settings.plane.keeps_metres = false;
  settings.plane.origin_in_words = [](double latitude, double longitude) {
    return fmt::format("--origin {:.6g},{:.6g}", latitude, longitude);
  };
  settings.plane.shift_in_words =
      "--shift moves the floes to the middle of the plane, --origin LAT,LON projects them about a place";
  settings.plane.source_in_words = "--from EPSG:n names it";
  const auto rules = read_rules(options);
  if (!rules) return rules.error();
  const std::string name = input_name(options.file);
  auto file = read_floes(options, name);
  if (!file) return file.error();
  const io::FloeText* const text = &file->text;
  io::FloesOfText read = io::floes_of(*text, *rules);
  const auto imported = with_progress(options.progress, "projecting and taking apart",
                                      [&] { return import_floes(read.floes, file->place, settings); });
  if (!imported) {
    std::string place = name;
    if (const auto floe = imported.error().floe) {
      const io::FloeEntry& entry = text->entries[*floe];
      place += fmt::format(":{}: feature {}, polygon {}", entry.line, entry.feature, entry.member);
    }
    return fail(kRefused, fmt::format("{}: {}; nothing was written", place, imported.error().words));
  }
  const io::ImportedIds ids = ids_of(*imported, read.floes, text->entries);
  std::ranges::copy(read.notes, std::back_inserter(file->notes));
  if (!ids.note.empty()) file->notes.push_back(ids.note);
  for (const std::string& note : file->notes) print_err("note: {}: {}\n", name, note);
  report_items(name, *imported, text->entries);
  const io::ImportTotals& totals = imported->totals;
  const bool are_all_refused = totals.refused > 0 && totals.refused == totals.read;
  std::optional<std::string> geojson;
  if (!are_all_refused) geojson = to_geojson(*imported, read.floes, text->entries, ids);
  if (const auto written =
          write_results(options, geojson, to_json_text(*imported, name, text->entries, read, file->notes));
      !written)
    return fail(kInputOutput, written.error());
  report_totals(name, *imported, read.near_misses);
  if (are_all_refused) return fail(kRefused, name + ": every floe was refused; only the report was written");
  return totals.refused == 0 ? kDone : kRefused;
}

void add_plane_options(CommandLine& command, ImportOptions& options) {
  const OptionTraits traits{.group = "The plane"};
  command.option("--origin", &options.origin, "LAT,LON",
                 "Project to metres about this place [°], x to the east; a third number is the heading of the x axis, "
                 "as in a scene's origin",
                 {}, traits);
  command.option("--crs", &options.settings.plane.target, "EPSG:n",
                 "Project to the plane of this system; any name that PROJ knows", not_empty(), traits);
  command.option("--from", &options.settings.plane.source, "EPSG:n",
                 "Coordinate system of the file, if the file states none", not_empty(), traits);
  command.flag("--shift", options.settings.plane.is_shifted,
               "Move the middle of the floes' box to (0, 0), by whole metres", traits);
  command.option("--tolerance", &options.settings.plane.tolerance, "M",
                 "Add points to edges that are not straight in the plane until they are within this distance of their "
                 "true course [m]; 0: none",
                 between(0, 1e5), traits);
}

void add_floe_options(CommandLine& command, ImportOptions& options) {
  io::ImportSettings& settings = options.settings;
  command.option("--join", &settings.join, "M",
                 "Join polygons of one feature, and polygons on both sides of longitude 180, whose boundaries are "
                 "within this distance of each other, and close narrower slits [m]",
                 between(0, 1e3));
  command.choice<geometry::FillRule>(
      "--repair", settings.repair,
      "Repair outlines that are not valid by this fill rule, exactly; if not given, they are refused",
      {{"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}});
  command.option("--simplify", &settings.simplify, "M",
                 "Leave out vertices within this distance of the remaining outline [m]", between(0, 1e4));
  command.option("--min-area", &settings.least_area, "M2", "Drop floes with less area [m²]", between(0, 1e12));
  command.option("--gap", &settings.gap, "M",
                 "Least distance between floes [m]; the smaller of two floes is trimmed to it", between(0, 1e3));
  const OptionTraits features{.group = "Features and properties"};
  command.option("--layer", &options.selection.layer, "NAME", "Layer to read, if the file has several", not_empty(),
                 features);
  command.option("--where", &options.selection.where, "SQL",
                 "Read only features whose properties satisfy this condition, as in ogr2ogr: \"POLY_TYPE = 'I'\"",
                 not_empty(), features);
  command.option("--property", &options.properties, "KEY=NAME",
                 "Name of a property in the file, with a factor for its unit, or values for its codes: "
                 "thickness_m=THICK, thickness_m=CM*0.01, thickness_m=SA[91:0.95 93:1.6]; may be repeated",
                 {}, {.group = features.group, .one_each_time = true});
  command.option("--nodata", &options.no_data, "N,N", "Numbers that mean \"no value\" in a property: -9,-9999",
                 not_empty(), features);
}

}  // namespace

Command add_cut(CommandLine& app) {
  CommandLine command =
      app.add_command("cut", "Cut floes exactly, with every square metre accounted for", kCutExamples);
  auto options = std::make_shared<CutOptions>();
  command.option("floes", &options->floes, "FLOES", "GeoJSON, NDJSON or WKT, recognised by content; - for stdin", {},
                 {.is_required = true});
  const auto tool = [&](const char* name, std::string& value, const char* type, const char* meaning) {
    command.option(name, &value, type, meaning, {}, {.group = "Tools, one of them"});
  };
  tool("--disc", options->disc, "X,Y,R", "Disc with this centre and radius [m]");
  tool("--crack", options->crack, "X,Y,ANGLE_DEG",
       "Straight crack through this point at this angle, across every floe");
  tool("--line", options->line, "X0,Y0,X1,Y1", "Line between two points; separates a floe if it crosses it completely");
  tool("--polygon", options->polygon, "FILE", "File of polygons, with or without holes, in any format of FLOES");
  tool("--ops", options->ops, "FILE", "JSON list of cuts (docs/cut.md), each applied in order to all pieces");
  command.choice<io::Keep>("--keep", options->keep, "Which side of a disc or polygon is kept; outside if not given",
                           {{"outside", io::Keep::kOutside}, {"inside", io::Keep::kInside}, {"both", io::Keep::kBoth}});
  command.option(
      "--sagitta", &options->sagitta, "M",
      "Largest distance between a disc and the polygon that replaces it [m]; 0.02, or radius/250 if that is less",
      between(1e-12, 1e6));
  command.option("--snap", &options->snap, "M",
                 "Extend ends of a line to the ice edge or another line within this distance [m]; if not given, only "
                 "within the rounding of the coordinates",
                 between(0, 1e6));
  command.option("--out", &options->out, "FILE",
                 "File for the pieces; the extension gives the format, otherwise it is that of FLOES; - for stdout");
  command.option("--ledger", &options->ledger, "FILE",
                 "File for the ledger, JSON; stdout if not given, unless the pieces are written there");
  command.choice<geometry::FillRule>(
      "--repair", options->repair,
      "Repair polygons that are not valid by this fill rule, exactly; if not given, they are refused",
      {{"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}});
  return {command, [options] { return cut_all(*options); }};
}

Command add_import(CommandLine& app) {
  CommandLine command =
      app.add_command("import", "Make a floe file from mapped ice: project, repair, remove overlaps", kImportExamples);
  auto options = std::make_shared<ImportOptions>();
  command.option("file", &options->file, "FILE",
                 "GeoJSON, NDJSON or WKT, recognised by content; any other format that GDAL's ogr2ogr reads; - for "
                 "stdin",
                 {}, {.is_required = true});
  command.option("--out", &options->out, "FILE", "File for the floes, GeoJSON in metres; - for stdout", not_empty(),
                 {.is_required = true});
  command.option("--report", &options->report, "FILE",
                 "File for the report, JSON; stdout if not given, unless the floes are written there");
  add_plane_options(command, *options);
  add_floe_options(command, *options);
  add_progress(command, options->progress);
  return {command, [options] { return import_all(*options); }};
}

}  // namespace polynya::app
