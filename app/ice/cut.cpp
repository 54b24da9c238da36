#include "io/text/cut.hpp"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <tuple>
#include <utility>

#include "app/command_line/command_line.hpp"
#include "app/command_line/console.hpp"
#include "app/command_line/files.hpp"
#include "io/import/plane.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

// ---- what it reports on stderr

constexpr std::size_t kMostReported = 100;  ///< messages; the ledger has all
constexpr std::size_t kMostVertices = 4;    ///< in a message; likewise

/// A line for each polygon that was rejected or repaired and each line that separates nothing, as
/// "floes.geojson:3: feature 1, polygon 0: …"; past the hundredth they are only counted.
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
  print_err(
      "polynya: {} -> {}; {:.9g} m2 = {:.9g} in pieces + {:.9g} removed (exact defect {}, rounding {:.2e} "
      "m2)\n",
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

/// What of the text is not in the pieces.
void report_losses(const std::string& name, const io::FloeText& floes, io::FloeFormat format) {
  const auto note = [&name](const char* words) { print_err("note: {}: {}\n", name, words); };
  if (floes.entries.empty()) note("no floes in it");
  if (floes.has_more_coordinates) note("third coordinates are ignored");
  if (floes.has_srid) note("SRID is ignored");
  if (floes.has_other_crs) note("its crs members differ; the pieces get the first");
  if (format != io::FloeFormat::kWkt) return;
  if (!floes.crs.empty()) note("WKT has no room for its crs");
  if (std::ranges::any_of(floes.entries, [](const io::FloeEntry& one) { return one.properties != nullptr; }))
    note("WKT has no room for properties");
}

// ---- the cuts

constexpr std::size_t kLongestOps = std::size_t{64} << 20;  ///< [bytes]

constexpr auto kCutExamples =
    "Examples:\n"
    "  polynya cut floes.geojson --disc 10,5,3 --out pieces.geojson        ledger to stdout\n"
    "  polynya cut floes.wkt --crack 0,0,30 --out - --ledger ledger.json   pieces to stdout\n"
    "  polynya cut - --polygon channel.geojson --keep both --out pieces.ndjson < floes.ndjson\n"
    "  polynya cut floes.geojson --ops cuts.json --repair even-odd --out pieces.geojson\n"
    "\n"
    "Exit codes: 0 all were cut, 2 usage, 4 some polygons were refused (the others are cut), 5 "
    "input/output.\n";

struct CutOptions {
  std::string floes;                            ///< a file, or "-" for stdin; so are the other files
  std::string disc, crack, line, polygon, ops;  ///< the one that is given; the others empty
  io::Keep keep = io::Keep::kOutside;
  double sagitta = 0;  ///< [m]; 0: by the radius
  std::string out;     ///< empty: none, or stdout where the ledger goes to a file
  std::string ledger;  ///< empty: stdout, unless the pieces go there
  std::optional<geometry::FillRule> repair;
};

tl::unexpected<Failure> failure(const std::string& where, const io::ToolError& error) {
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
    return one_op(option, io::op_of_numbers(option + 2, *numbers, options.sagitta), options.keep);
  }
  const std::string& file = options.polygon.empty() ? options.ops : options.polygon;
  auto text = read_input(file, options.polygon.empty() ? kLongestOps : io::kLongestFloeText);
  if (!text) return failure(kInputOutput, fmt::format("{}: {}", file, text.error()));
  if (!options.polygon.empty()) {
    const auto as_op = [](io::PolygonTool&& tool) { return io::CutOp{std::move(tool), {}}; };
    return one_op(file.c_str(), io::polygon_tool(std::move(*text)).map(as_op), options.keep);
  }
  auto ops = io::read_cut_ops(*text, {options.keep, options.sagitta});
  if (!ops) return failure(file, ops.error());
  return *std::move(ops);
}

/// The format that the extension of --out names; none where it has no extension.
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

/// Pieces go to --out; the ledger to --ledger, or to stdout unless the pieces are there.
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

/// Degrees have no areas in m².
Outcome<void> check_units(const std::string& name, const io::FloeText& floes) {
  constexpr auto kRemedy = "polynya import makes metres of them";
  const std::string crs = io::crs_name(floes.crs);
  const auto known = io::find_crs(crs);
  if (!crs.empty() && known && known->is_geographic)
    return failure(kRefused,
                   fmt::format("{}: crs: longitude and latitude ({}), areas would not be m2: {}", name, crs, kRemedy));
  io::CoordinateEvidence evidence;
  for (const io::FloeEntry& entry : floes.entries) evidence.add(entry.polygon);
  if (floes.crs.empty() && floes.format != io::FloeFormat::kWkt && evidence.look_polar())
    print_err("note: {}: these look like longitude and latitude; areas and lengths are then in degrees: {}\n", name,
              kRemedy);
  return {};
}

Outcome<ExitCode> cut_all(const CutOptions& options) {
  if (!options.out.empty() && options.out == options.ledger)
    return failure(kUsage, "--out and --ledger are one and the same");
  if (options.floes == "-" && (options.polygon == "-" || options.ops == "-"))
    return failure(kUsage, "stdin can be read once");
  const auto wanted_format = output_format(options.out);
  if (!wanted_format) return tl::unexpected(wanted_format.error());
  auto ops = read_ops(options);
  if (!ops) return tl::unexpected(ops.error());
  const std::string name = input_name(options.floes);
  auto text = read_input(options.floes, io::kLongestFloeText);
  if (!text) return failure(kInputOutput, fmt::format("{}: {}", name, text.error()));
  const auto floes = io::read_floe_text(std::move(*text));
  if (!floes) return failure(kInputOutput, fmt::format("{}:{}", name, floes.error()));
  if (const auto units = check_units(name, *floes); !units) return tl::unexpected(units.error());
  const io::FloeFormat format = wanted_format->value_or(floes->format);
  report_losses(name, *floes, format);
  io::CutReport report = cut_floes(floes->entries, std::move(*ops), options.repair);
  report.crs = floes->crs;
  report_floes(name, report);
  if (const auto written = write_results(options, report, format); !written)
    return failure(kInputOutput, written.error());
  report_totals(report);
  return io::totals_of(report).rejected == 0 ? kDone : kRefused;
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
  tool("--disc", options->disc, "X,Y,R", "The disc of that centre and radius [m]");
  tool("--crack", options->crack, "X,Y,ANGLE_DEG", "The straight line through that point, across every floe");
  tool("--line", options->line, "X0,Y0,X1,Y1", "From end to end; separates where it crosses ice fully");
  tool("--polygon", options->polygon, "FILE", "Polygons, with holes or not, in any format of FLOES");
  tool("--ops", options->ops, "FILE", "A JSON list of cuts, in order, each of all pieces");
  command.choice<io::Keep>("--keep", options->keep, "Which side of a disc or polygon stays; outside if not given",
                           {{"outside", io::Keep::kOutside}, {"inside", io::Keep::kInside}, {"both", io::Keep::kBoth}});
  command.option("--sagitta", &options->sagitta, "M",
                 "By how much a disc's polygon may stay inside it [m]; 0.02, or radius/250 if that is less",
                 between(1e-12, 1e6));
  command.option("--out", &options->out, "FILE", "The pieces; format by extension, else that of FLOES; - for stdout");
  command.option("--ledger", &options->ledger, "FILE", "The ledger, JSON; stdout if not given");
  command.choice<geometry::FillRule>(
      "--repair", options->repair,
      "Make valid polygons of those that are not, exactly, by what the rule fills; else they are refused",
      {{"even-odd", geometry::FillRule::kEvenOdd}, {"non-zero", geometry::FillRule::kNonZero}});
  return {command, [options] { return code_of(cut_all(*options)); }};
}

}  // namespace polynya::app
