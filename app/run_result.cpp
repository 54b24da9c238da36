#include "app/run_result.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/force_report.hpp"

namespace polynya::app {

void print_result(const io::RunSummary& summary, const simulation::Scene& scene,
                  const std::filesystem::path& folder, const std::string& picture) {
  const auto& counts = summary.counts;
  const auto& ledger = summary.ledger;
  print_out("simulated   {:.6g} s in {:.3g} s, {:.3g} x real time\n", summary.sim_time, summary.wall_time,
            summary.real_time_factor());
  print_out("fractures   {} cusps broken by bending, {} splits, {} rejected cuts\n", counts.bends,
            counts.splits, counts.rejected_cuts);
  print_out("floes       {} -> {}\n", counts.floes_initial, counts.floes_final);
  print_out(
      "ice         {:.6f} m2 = {:.6f} floes + {:.6f} submerged + {:.6f} brash (imbalance {:.1e}, rounding "
      "{:.1e} m2)\n",
      ledger.initial_ice_area, ledger.floe_area, ledger.submerged_area, ledger.brash_area, ledger.imbalance,
      ledger.rounding_defect);
  const simulation::EnergyFlows& energy = summary.audit.sums.energy;
  print_out(
      "energy      {:.4g} kJ in: {:.4g} drag, {:.4g} friction, {:.4g} crushing, {:.4g} collisions, {:.4g} in "
      "motion (imbalance {:.1e} of it)\n",
      (energy.thrust + energy.current + summary.audit.sums.initial_energy) / 1e3, energy.drag / 1e3,
      energy.friction / 1e3, energy.crushing / 1e3, energy.restitution / 1e3,
      summary.audit.kinetic_energy / 1e3,
      summary.audit.energy_imbalance / std::max(summary.audit.turnover, 1e-300));
  print_out("{}", force_lines(summary, scene));
  print_out("run folder  {}\n", folder.string());
  if (!picture.empty()) print_out("picture     {}\n", (folder / picture).string());
}

}  // namespace polynya::app
