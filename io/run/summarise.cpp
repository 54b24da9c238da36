#include "io/run/summarise.hpp"

#include <fmt/format.h>

#include "io/run/run_folder.hpp"
#include "simulation/world.hpp"

namespace polynya::io {

using simulation::Simulation;

namespace {

constexpr std::size_t kMostShipContacts = 5;  ///< that each have a warning

/// A warning for each two ships or structures that came into contact, the first few of them.
std::vector<std::string> ship_contact_warnings(const simulation::Simulation& simulation) {
  std::vector<std::string> warnings;
  const auto& contacts = simulation.world().accounts.ship_contacts;
  const auto& ships = simulation.scene().ships;
  for (const simulation::ShipContact& c : contacts) {
    if (warnings.size() == kMostShipContacts) {
      warnings.push_back(
          fmt::format("{} more pairs of ships and structures came into contact (events.ndjson)",
                      contacts.size() - kMostShipContacts));
      break;
    }
    warnings.push_back(fmt::format(
        "{} and {} came into contact at {:.6g} s, closing at {:.3g} m/s; {}",
        ships[static_cast<std::size_t>(c.ship)].name, ships[static_cast<std::size_t>(c.other)].name, c.time,
        c.closing_speed,
        c.is_prescribed ? "the motion of both is prescribed, so they pass through each other and no force is "
                          "computed: give the ship thrust_N"
                        : "forces.csv has these loads apart from those of ice, in its *_from_ships columns"));
  }
  return warnings;
}

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

RunSummary summarise(const Simulation& simulation, const RunWriter& writer, const std::string& stopped_by,
                     double wall_time) {
  RunSummary summary;
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
                    name, kLongestRunFile));
  return summary;
}

}  // namespace polynya::io
