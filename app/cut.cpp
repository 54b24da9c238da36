#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <utility>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/cut_floes.hpp"
#include "app/exit_code.hpp"
#include "app/geometry_commands.hpp"
#include "app/read_input.hpp"
#include "app/write_output.hpp"
#include "io/text/cut_ops.hpp"
#include "io/text/cut_report.hpp"
#include "io/text/degrees.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::app {
namespace {

constexpr std::size_t kLongestOps = std::size_t{64} << 20;  ///< [bytes]
constexpr std::size_t kMostReported = 100;                  ///< messages; the ledger has all
constexpr std::size_t kMostVertices = 4;                    ///< in a message; likewise

/// Ends the command; the message has been made.
struct Failure {
  ExitCode code;
  std::string words;
};
template <class Value>
using Outcome = tl::expected<Value, Failure>;

tl::unexpected<Failure> fail(ExitCode code, std::string words) {
  return tl::unexpected(Failure{code, std::move(words)});
}
tl::unexpected<Failure> fail(const std::string& where, const io::ToolError& error) {
  const bool is_invalid = error.kind == io::ToolError::Kind::kInvalidPolygon;
  return fail(is_invalid ? kRefused : kUsage, fmt::format("{}: {}", where, error.words));
}

Outcome<std::vector<double>> numbers(const char* option, const std::string& text, std::size_t wanted) {
  auto read = io::read_numbers(text, wanted);
  if (!read) return fail(kUsage, fmt::format("{}: {}", option, read.error()));
  return *std::move(read);
}

template <class Tool>
Outcome<std::vector<io::CutOp>> one_op(const char* where, io::ToolOutcome<Tool> tool, io::Keep keep) {
  if (!tool) return fail(where, tool.error());
  return std::vector<io::CutOp>{{std::move(*tool), keep}};
}

Outcome<std::vector<io::CutOp>> read_ops(const CutOptions& options) {
  const std::string* const tools[] = {&options.disc, &options.crack, &options.line, &options.polygon,
                                      &options.ops};
  const auto given = std::ranges::count_if(tools, [](const std::string* tool) { return !tool->empty(); });
  if (given != 1) {
    return fail(kUsage, fmt::format("one of --disc, --crack, --line, --polygon, --ops is needed, {} given",
                                    given == 0 ? "none is" : fmt::format("{} are", given)));
  }
  if (!options.disc.empty()) {
    const auto n = numbers("--disc", options.disc, 3);
    if (!n) return tl::unexpected(n.error());
    return one_op("--disc", io::disc_tool(*n, options.sagitta), options.keep);
  }
  if (!options.crack.empty()) {
    const auto n = numbers("--crack", options.crack, 3);
    if (!n) return tl::unexpected(n.error());
    return std::vector<io::CutOp>{{io::CrackTool{{(*n)[0], (*n)[1]}, (*n)[2]}, options.keep}};
  }
  if (!options.line.empty()) {
    const auto n = numbers("--line", options.line, 4);
    if (!n) return tl::unexpected(n.error());
    return one_op("--line", io::line_tool({{(*n)[0], (*n)[1]}, {(*n)[2], (*n)[3]}}), options.keep);
  }
  const std::string& file = options.polygon.empty() ? options.ops : options.polygon;
  auto text = read_input(file, options.polygon.empty() ? kLongestOps : io::kLongestFloeText);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", file, text.error()));
  if (!options.polygon.empty()) return one_op(file.c_str(), io::polygon_tool(std::move(*text)), options.keep);
  auto ops = io::read_cut_ops(std::move(*text), {options.keep, options.sagitta});
  if (!ops) return fail(file, ops.error());
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
  return fail(kUsage,
              fmt::format("--out {}: no format has the extension {}; GeoJSON: .geojson, .json; NDJSON: "
                          ".ndjson, .jsonl, .geojsonl; WKT: .wkt (others: ogr2ogr converts GeoJSON)",
                          file, extension));
}

/// Told as "floes.geojson:3: feature 1: …"; past the hundredth only counted.
void report_floes(const std::string& name, const io::CutReport& report) {
  std::size_t told = 0;
  const auto report_of = [&](const io::CutFloe& floe, const std::string& words) {
    if (++told > kMostReported) return;
    print_err("{}:{}: feature {}, polygon {}: {}\n", name, floe.line, floe.feature, floe.member, words);
  };
  for (const io::CutFloe& floe : report.floes) {
    if (floe.rejected) {
      std::string words = floe.rejected->reason;
      if (!floe.rejected->detail.empty()) words += ": " + floe.rejected->detail;
      const auto& vertices = floe.rejected->vertices;
      for (std::size_t i = 0; i < std::min(vertices.size(), kMostVertices); ++i)
        words += fmt::format("{}({}, {})", i == 0 ? " at " : ", ", vertices[i].x, vertices[i].y);
      if (vertices.size() > kMostVertices)
        words += fmt::format(" and {} more", vertices.size() - kMostVertices);
      report_of(floe, words);
    }
    if (floe.repair) {
      report_of(floe, fmt::format("{}, repaired ({}): {} polygon{}, {:+} m2 to the {} m2 drawn",
                                  floe.repair->defect, floe.repair->rule, floe.repair->shapes,
                                  floe.repair->shapes == 1 ? "" : "s", floe.repair->area_changed,
                                  floe.repair->area_drawn));
    }
    for (const io::Dangling& one : floe.dangling) {
      report_of(floe, fmt::format("the line separates nothing from ({}, {}) to ({}, {}), {:.6g} m",
                                  one.from.x, one.from.y, one.to.x, one.to.y, distance(one.from, one.to)));
    }
  }
  if (told > kMostReported) print_err("polynya: {} more; the ledger has all\n", told - kMostReported);
}

void report_totals(const io::CutReport& report) {
  const io::CutTotals totals = io::totals_of(report);
  const auto floes = std::ranges::count_if(
      report.floes, [](const io::CutFloe& floe) { return !floe.rejected || !floe.pieces.empty(); });
  print_err(
      "polynya: {} floe{} -> {} piece{}; {:.9g} m2 = {:.9g} in pieces + {:.9g} removed (exact defect "
      "{}, rounding "
      "{:.2e} m2)\n",
      floes, floes == 1 ? "" : "s", totals.pieces, totals.pieces == 1 ? "" : "s", totals.area,
      totals.area_of_pieces, totals.removed, totals.exact_defect, totals.rounding_defect);
  if (totals.snap_rounded > 0) {
    print_err("polynya: {} piece{} snap-rounded: nearest doubles did not make a valid polygon\n",
              totals.snap_rounded, totals.snap_rounded == 1 ? " was" : "s were");
  }
  if (totals.rejected > 0) {
    print_err("polynya: {} refused; {}\n", totals.rejected,
              totals.rejected == totals.floes ? "nothing was cut" : "the others were cut");
  }
}

/// Pieces go to --out; the ledger to --ledger, or to stdout unless the pieces are there.
std::string write_results(const CutOptions& options, const io::CutReport& report, io::FloeFormat format) {
  std::string ledger = options.ledger;
  std::string out = options.out;
  if (ledger.empty() && out != "-") ledger = "-";
  if (out.empty() && !ledger.empty() && ledger != "-") out = "-";
  if (!out.empty()) {
    std::string failure = write_output(out, to_floe_text(report, format));
    if (!failure.empty()) return failure;
  } else {
    print_err("polynya: the ledger is on stdout; name --out FILE for the pieces, or --ledger FILE\n");
  }
  return ledger.empty() ? "" : write_output(ledger, to_ledger_json(report));
}

io::CoordinateEvidence evidence_of(const io::FloeText& floes) {
  io::CoordinateEvidence evidence;
  for (const io::FloeEntry& entry : floes.entries) evidence.add(entry.polygon);
  return evidence;
}

/// A file whose crs is in degrees has no areas in m².
Outcome<bool> check_units(const std::string& name, const io::FloeText& floes) {
  const std::string crs = floes.crs.empty() ? "" : io::geographic_crs(io::parse_json(floes.crs).root);
  if (!crs.empty()) {
    return fail(kRefused, fmt::format("{}: crs: longitude and latitude ({}), areas would not be m2: {}", name,
                                      crs, io::how_to_project(evidence_of(floes).box, name)));
  }
  if (floes.crs.empty() && floes.format != io::FloeFormat::kWkt && evidence_of(floes).look_polar()) {
    print_err("note: {}: these look like longitude and latitude; areas and lengths are then in degrees: {}\n",
              name, io::how_to_project(evidence_of(floes).box, name));
  }
  return true;
}

/// What of the text is not in the pieces.
void report_losses(const std::string& name, const io::FloeText& floes, io::FloeFormat format) {
  const auto note = [&name](const char* words) { print_err("note: {}: {}\n", name, words); };
  if (floes.entries.empty()) note("no floes in it");
  if (floes.has_more_coordinates) note("third coordinates are passed over");
  if (floes.has_srid) note("SRID is passed over");
  if (floes.has_other_crs) note("its crs members differ; the pieces get the first");
  if (format != io::FloeFormat::kWkt) return;
  if (!floes.crs.empty()) note("WKT has no room for its crs");
  if (std::ranges::any_of(floes.entries, [](const io::FloeEntry& one) { return one.properties != nullptr; }))
    note("WKT has no room for properties");
}

Outcome<bool> cut_all(const CutOptions& options) {
  if (!options.out.empty() && options.out == options.ledger)
    return fail(kUsage, "--out and --ledger are one and the same");
  if (options.floes == "-" && (options.polygon == "-" || options.ops == "-"))
    return fail(kUsage, "stdin can be read once");
  const auto wanted_format = output_format(options.out);
  if (!wanted_format) return tl::unexpected(wanted_format.error());
  auto ops = read_ops(options);
  if (!ops) return tl::unexpected(ops.error());
  const std::string name = options.floes == "-" ? "stdin" : options.floes;
  auto text = read_input(options.floes, io::kLongestFloeText);
  if (!text) return fail(kInputOutput, fmt::format("{}: {}", name, text.error()));
  const auto floes = io::read_floe_text(std::move(*text));
  if (!floes) return fail(kInputOutput, fmt::format("{}:{}", name, floes.error()));
  if (auto units = check_units(name, *floes); !units) return units;
  const io::FloeFormat format = wanted_format->value_or(floes->format);
  report_losses(name, *floes, format);
  io::CutReport report = cut_floes(floes->entries, std::move(*ops), options.repair);
  report.crs = floes->crs;
  report_floes(name, report);
  if (const std::string failure = write_results(options, report, format); !failure.empty())
    return fail(kInputOutput, failure);
  report_totals(report);
  return io::totals_of(report).rejected == 0;
}

}  // namespace

int cut(const CutOptions& options) {
  const auto all_cut = cut_all(options);
  if (all_cut) return *all_cut ? kDone : kRefused;
  print_err("polynya: {}\n", all_cut.error().words);
  return all_cut.error().code;
}

}  // namespace polynya::app
