#include "analysis/run_result.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <vector>

#include <fmt/format.h>

#include "io/run/records.hpp"
#include "io/text/problem.hpp"

namespace polynya::analysis {
namespace {

using io::counted;

/// "-1.89 MN"
std::string with_unit(double newtons) {
  const double size = std::abs(newtons);
  return size >= 1e6   ? fmt::format("{:.4g} MN", newtons / 1e6)
         : size >= 1e3 ? fmt::format("{:.4g} kN", newtons / 1e3)
                       : fmt::format("{:.4g} N", newtons);
}

std::string with_time(const io::Peak& peak) {
  if (peak.value == 0) return "0 N";
  return fmt::format("{} at {:.6g} s", with_unit(peak.value), peak.time);
}

/// What a peak of that column is of.
std::string measure_of(const io::ForceColumn& column, const simulation::Scene& scene) {
  if (column.curve == "paper") return "j/τ_c of the paper";
  return column.over == io::Over::kMean ? fmt::format("mean over {:.6g} s", recording_interval(scene))
                                        : fmt::format("single step of {:.6g} s", scene.time.step);
}

/// The largest loads on each ship and structure (docs/theory/forces.md): of ice, then of other ships
/// and structures, the paper's last.
std::string force_lines(const io::RunSummary& summary, const simulation::Scene& scene) {
  std::string text;
  const std::vector<const io::ForceColumn*> columns = io::peak_columns(scene);
  for (const io::ShipPeaks& peaks : summary.peaks) {
    bool is_free = true;
    for (std::size_t i = 0; i + 1 < columns.size(); ++i) {
      const bool is_by_ice = columns[i]->plot == "Surge force of the ice";
      if (!is_by_ice && columns[i]->plot != "Surge force of ships") continue;
      const io::Peak& surge = peaks.of_column[i];
      const io::Peak& sway = peaks.of_column[i + 1];
      if (surge.value == 0 && sway.value == 0) continue;
      is_free = false;
      text += fmt::format("{:<12}{}: surge {}, sway {} (largest {})\n", is_by_ice ? "ice force" : "ship force",
                          peaks.ship, with_time(surge), with_time(sway), measure_of(*columns[i], scene));
    }
    if (is_free) text += fmt::format("ice force   {}: none\n", peaks.ship);
  }
  return text;
}

std::string under_hull_lines(const simulation::Counts& counts, const simulation::AreaLedger& ledger) {
  if (counts.went_under == 0) return "";
  return fmt::format("under hull  {} went under, {} of them tilted floes; {} came up, {} stayed under the ice\n",
                     counted(counts.went_under, "piece"), counts.tilted_under, counts.came_up, counts.stayed_under) +
         fmt::format("            {:.6f} m2 are there at the end, {:.6f} m2 stayed under the ice\n",
                     ledger.under_hull_area, ledger.under_ice_area);
}

/// "ticks of 0.05 s, steps of 0.025 to 0.4 s".
std::string steps_of(const simulation::Counts& counts, double tick) {
  const std::vector<io::StepsTaken> taken = io::steps_taken(counts);
  std::string ticks = fmt::format("ticks of {:g} s", tick);
  if (taken.empty() || (taken.front().level == 0 && taken.back().level == 0)) return ticks;
  return fmt::format("{}, steps of {:g} to {:g} s", ticks, std::ldexp(tick, taken.front().level),
                     std::ldexp(tick, taken.back().level));
}

}  // namespace

std::string result_text(const io::RunSummary& summary, const simulation::Scene& scene) {
  std::string text;
  const auto add = [&text]<class... Values>(fmt::format_string<Values...> format, Values&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<Values>(values)...);
  };
  const auto& counts = summary.counts;
  const auto& ledger = summary.ledger;
  add("simulated   {:.6g} s in {:.3g} s, {:.3g} x real time; {}\n", summary.sim_time, summary.wall_time,
      summary.real_time_factor(), steps_of(counts, scene.time.step));
  add("fractures   {} broken by bending, {}, {}\n", counted(counts.bends, "cusp"), counted(counts.splits, "split"),
      counted(counts.rejected_cuts, "rejected cut"));
  if (counts.ground > 0)
    add("ground      {} that contacts did not part, to brash\n", counted(counts.ground, "overlap"));
  text += under_hull_lines(counts, ledger);
  add("floes       {} -> {}\n", counts.floes_initial, counts.floes_final);
  const double submerged = ledger.submerged_area + ledger.under_hull_area + ledger.under_ice_area;
  add("ice         {:.6f} m2 = {:.6f} floes + {:.6f} submerged + {:.6f} brash (imbalance {:.1e}, rounding "
      "{:.1e} m2)\n",
      ledger.initial_ice_area, ledger.floe_area, submerged, ledger.brash_area, ledger.imbalance,
      ledger.rounding_defect);
  const auto& masses = summary.masses;
  add("            {:.6g} t = {:.6g} floes + {:.6g} submerged + {:.6g} brash (imbalance {:.1e} t)\n",
      1e-3 * masses.initial_ice_mass, 1e-3 * masses.floe_mass,
      1e-3 * (masses.submerged_mass + masses.under_hull_mass + masses.under_ice_mass), 1e-3 * masses.brash_mass,
      1e-3 * masses.imbalance);
  const simulation::EnergyFlows& energy = summary.audit.sums.energy;
  const simulation::BoundaryFlows& boundaries = summary.audit.sums.boundaries;
  add("energy      {:.4g} kJ in: {:.4g} drag, {:.4g} friction, {:.4g} crushing, {:.4g} collisions, {:.4g} in "
      "motion (imbalance {:.1e} of it)\n",
      (energy.thrust + energy.current + boundaries.wind + boundaries.walls + summary.audit.sums.initial_energy) / 1e3,
      energy.drag / 1e3, energy.friction / 1e3, energy.crushing / 1e3, energy.restitution / 1e3,
      summary.audit.kinetic_energy / 1e3, summary.audit.energy_imbalance / std::max(summary.audit.turnover, 1e-300));
  return text + force_lines(summary, scene);
}

}  // namespace polynya::analysis
