#include "app/run_result.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/force_report.hpp"
#include "io/run/run_folder.hpp"

namespace polynya::app {

using simulation::Simulation;

namespace {

std::vector<std::string> warnings_of(const Simulation& simulation, const simulation::Counts& counts) {
  std::vector<std::string> warnings = ship_contact_warnings(simulation);
  const auto warn = [&](std::int64_t count, const char* words) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, words));
  };
  warn(counts.rejected_cuts, "cuts were rejected; events.ndjson has each with its reason");
  warn(counts.unconverged_steps, "steps used all sweeps of the impulse solver (contact.iterations)");
  warn(counts.database_out_of_range, "bending loads lay outside the database's range");
  if (const simulation::Audit audit = simulation.audit(); !audit.is_closed()) {
    warnings.push_back(fmt::format(
        "THE AUDIT IS BROKEN: energy is off by {:.2e} J of {:.2e} J, momentum by {:.2e} N s of {:.2e} N s; "
        "do not trust this run, and please report it with its failure.bin",
        audit.energy_imbalance, audit.turnover, length(audit.momentum_imbalance), audit.momentum_turnover));
  }
  if (simulation.scene().fracture.characteristic_length == fracture::CharacteristicLength::kAsPrinted)
    warnings.emplace_back("fracture.characteristic_length is as_printed: Eq. (7) with the paper's misprint");
  return warnings;
}

}  // namespace

io::RunSummary summarise(const Simulation& simulation, const io::RunWriter& writer,
                         const std::string& stopped_by, double wall_time) {
  io::RunSummary summary;
  summary.finished = stopped_by.empty();
  summary.stopped_by = stopped_by;
  summary.counts = simulation.counts();
  summary.steps = summary.counts.steps;
  summary.sim_time = simulation.time();
  summary.wall_time = wall_time;
  summary.ledger = simulation.area_ledger();
  summary.audit = simulation.audit();
  summary.peaks = writer.peaks();
  summary.warnings = warnings_of(simulation, summary.counts);
  for (const std::string& name : writer.overlong())
    summary.warnings.push_back(
        fmt::format("{} has more than the {} bytes that inspect, view and the others read; record less (the "
                    "scene's record)",
                    name, io::kLongestRunFile));
  return summary;
}

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
