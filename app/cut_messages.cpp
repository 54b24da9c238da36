#include "app/cut_messages.hpp"

#include <algorithm>

#include "app/console.hpp"
#include "io/text/problem.hpp"

namespace polynya::app {
namespace {

constexpr std::size_t kMostReported = 100;  ///< messages; the ledger has all
constexpr std::size_t kMostVertices = 4;    ///< in a message; likewise

}  // namespace

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
      if (vertices.size() > kMostVertices)
        words += fmt::format(" and {} more", vertices.size() - kMostVertices);
      report_of(floe, words);
    }
    if (floe.repair) {
      report_of(floe, fmt::format("{}, repaired ({}): {}, {:+} m2 to the {} m2 drawn", floe.repair->defect,
                                  floe.repair->rule, counted(floe.repair->shapes, "polygon"),
                                  floe.repair->area_changed, floe.repair->area_drawn));
    }
    for (const io::Dangling& one : floe.dangling) {
      report_of(floe, fmt::format("the line separates nothing from ({}, {}) to ({}, {}), {:.6g} m",
                                  one.from.x, one.from.y, one.to.x, one.to.y, distance(one.from, one.to)));
    }
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
      counted(floes, "floe"), counted(totals.pieces, "piece"), totals.area, totals.area_of_pieces,
      totals.removed, totals.exact_defect, totals.rounding_defect);
  if (totals.snap_rounded > 0) {
    print_err("polynya: {} piece{} snap-rounded: nearest doubles did not make a valid polygon\n",
              totals.snap_rounded, totals.snap_rounded == 1 ? " was" : "s were");
  }
  if (totals.rejected > 0) {
    print_err("polynya: {} refused; {}\n", totals.rejected,
              totals.rejected == totals.floes ? "nothing was cut" : "the others were cut");
  }
}

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

}  // namespace polynya::app
