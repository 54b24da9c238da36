#include "app/run_result.hpp"

#include <algorithm>
#include <cmath>

#include "app/console.hpp"
#include "io/run/shown_loads.hpp"

namespace polynya::app {
namespace {

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

/// The largest loads on each ship and structure, the true force first (io/run/shown_loads.hpp).
std::string force_lines(const io::RunSummary& summary, const simulation::Scene& scene) {
  std::string text;
  const std::vector<io::ShownLoad> loads = io::shown_loads(scene);
  const std::vector<const io::ForceColumn*> columns = io::peak_columns(scene);
  for (const io::ShipPeaks& peaks : summary.peaks) {
    const auto peak_of = [&](const io::ForceColumn& column) -> const io::Peak& {
      return peaks.of_column.at(
          static_cast<std::size_t>(std::ranges::find(columns, &column) - columns.begin()));
    };
    bool is_free = true;
    for (const io::ShownLoad& load : loads) {
      const io::Peak& surge = peak_of(*load.columns[0]);
      const io::Peak& sway = peak_of(*load.columns[1]);
      if (surge.value == 0 && sway.value == 0) continue;
      is_free = false;
      text += fmt::format("{:<12}{}: surge {}, sway {} (largest {})\n",
                          load.is_by_ice ? "ice force" : "ship force", peaks.ship, with_time(surge),
                          with_time(sway), load.measure);
    }
    if (is_free) text += fmt::format("ice force   {}: none\n", peaks.ship);
  }
  return text;
}

}  // namespace

namespace {

void print_under_hull(const simulation::Counts& counts, const simulation::AreaLedger& ledger) {
  if (counts.went_under == 0) return;
  print_out("under hull  {} went under, {} of them tilted floes; {} came up, {} stayed under the ice\n",
            counted(counts.went_under, "piece"), counts.tilted_under, counts.came_up, counts.stayed_under);
  print_out("            {:.6f} m2 are there at the end, {:.6f} m2 stayed under the ice\n",
            ledger.under_hull_area, ledger.under_ice_area);
}

}  // namespace

void print_result(const io::RunSummary& summary, const simulation::Scene& scene,
                  const std::filesystem::path& folder, const std::string& picture) {
  const auto& counts = summary.counts;
  const auto& ledger = summary.ledger;
  print_out("simulated   {:.6g} s in {:.3g} s, {:.3g} x real time\n", summary.sim_time, summary.wall_time,
            summary.real_time_factor());
  print_out("fractures   {} broken by bending, {}, {}\n", counted(counts.bends, "cusp"),
            counted(counts.splits, "split"), counted(counts.rejected_cuts, "rejected cut"));
  if (counts.ground > 0)
    print_out("ground      {} that no contact could part, to brash\n", counted(counts.ground, "overlap"));
  print_under_hull(counts, ledger);
  print_out("floes       {} -> {}\n", counts.floes_initial, counts.floes_final);
  const double submerged = ledger.submerged_area + ledger.under_hull_area + ledger.under_ice_area;
  print_out(
      "ice         {:.6f} m2 = {:.6f} floes + {:.6f} submerged + {:.6f} brash (imbalance {:.1e}, rounding "
      "{:.1e} m2)\n",
      ledger.initial_ice_area, ledger.floe_area, submerged, ledger.brash_area, ledger.imbalance,
      ledger.rounding_defect);
  const auto& masses = summary.masses;
  print_out("            {:.6g} t = {:.6g} floes + {:.6g} submerged + {:.6g} brash (imbalance {:.1e} t)\n",
            1e-3 * masses.initial_ice_mass, 1e-3 * masses.floe_mass,
            1e-3 * (masses.submerged_mass + masses.under_hull_mass + masses.under_ice_mass),
            1e-3 * masses.brash_mass, 1e-3 * masses.imbalance);
  const simulation::EnergyFlows& energy = summary.audit.sums.energy;
  const simulation::BoundaryFlows& boundaries = summary.audit.sums.boundaries;
  print_out(
      "energy      {:.4g} kJ in: {:.4g} drag, {:.4g} friction, {:.4g} crushing, {:.4g} collisions, {:.4g} in "
      "motion (imbalance {:.1e} of it)\n",
      (energy.thrust + energy.current + boundaries.wind + boundaries.walls +
       summary.audit.sums.initial_energy) /
          1e3,
      energy.drag / 1e3, energy.friction / 1e3, energy.crushing / 1e3, energy.restitution / 1e3,
      summary.audit.kinetic_energy / 1e3,
      summary.audit.energy_imbalance / std::max(summary.audit.turnover, 1e-300));
  print_out("{}", force_lines(summary, scene));
  print_out("run folder  {}\n", folder.string());
  if (!picture.empty()) print_out("picture     {}\n", (folder / picture).string());
}

}  // namespace polynya::app
