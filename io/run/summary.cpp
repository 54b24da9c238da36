#include "io/run/summary.hpp"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

#include "io/import/floe_properties.hpp"
#include "io/run/records.hpp"
#include "io/run/run_folder.hpp"
#include "io/run/run_writer.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/problem.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/world.hpp"

namespace polynya::io {
namespace {

using simulation::Simulation;

void append(JsonWriter& json, const ShipPeaks& peaks, const std::vector<const ForceColumn*>& columns) {
  const auto add = [&](std::string_view name, const Peak& peak) {
    json.key(name).open('{').key("value").value(peak.value).key("t_s").value(peak.time).close('}');
  };
  json.key("ship").value(peaks.ship);
  add("contact_peak_N", peaks.of_contact);
  for (std::size_t i = 0; i < columns.size(); ++i) add(columns[i]->name, peaks.of_column[i]);
}

void append_places(JsonWriter& json, const simulation::IceLedger& ledger, const std::string& amount) {
  json.key("initial_ice_" + amount).value(ledger.initial).key("floe_" + amount).value(ledger.floes);
  json.key("under_hull_" + amount).value(ledger.under_hulls).key("under_ice_" + amount).value(ledger.under_ice);
  json.key("submerged_" + amount).value(ledger.submerged).key("brash_" + amount).value(ledger.brash);
}

void append(JsonWriter& json, const simulation::IceLedger& areas, const simulation::IceLedger& masses) {
  json.key("ledger").open('{');
  append_places(json, areas, "area_m2");
  json.key("rounding_defect_m2").value(areas.rounding).key("imbalance_m2").value(areas.imbalance());
  append_places(json, masses, "mass_kg");
  json.key("rounding_mass_kg").value(masses.rounding).key("imbalance_kg").value(masses.imbalance());
  json.close('}');
}

/// Writes the ice properties of floes if they differ from those of the scene.
void append_ice_of_floes(JsonWriter& json, const simulation::Scene& scene) {
  if (scene.own_ice.empty()) return;
  const auto own = std::ranges::count_if(
      scene.floes, [](const simulation::FloeSpec& floe) { return floe.own_ice != simulation::kSceneIce; });
  json.key("ice").open('{').key("floes_with_own_ice").value(static_cast<std::int64_t>(own));
  for (const FloeProperty& property : floe_ice_properties()) {
    double least = std::numeric_limits<double>::infinity(), most = 0, mean = 0;
    for (const simulation::FloeSpec& floe : scene.floes) {
      const double value = ice_of(scene, floe.own_ice).*property.ice;
      least = std::min(least, value);
      most = std::max(most, value);
      mean += value / static_cast<double>(scene.floes.size());
    }
    json.key(property.key).open('{').key("least").value(least).key("mean").value(mean);
    json.key("most").value(most).close('}');
  }
  json.close('}');
}

/// Writes the terms of the energy balance that moorings store or dissipate.
void append_stored(JsonWriter& json, const simulation::Audit& audit) {
  const simulation::MooringFlows& m = audit.sums.moorings;
  json.key("initial_stored_J").value(m.initial).key("stored_J").value(audit.stored_energy);
  json.key("mooring_ground_J").value(m.ground).key("mooring_damping_J").value(m.damping);
  json.key("mooring_breaking_J").value(m.breaking).key("mooring_separation_J").value(m.separation);
}

/// Writes the energy and momentum exchanged between ships and their moorings.
void append_moorings(JsonWriter& json, const simulation::Audit& audit) {
  const simulation::MooringFlows& m = audit.sums.moorings;
  json.key("moorings").open('{').key("stored_J").value(audit.stored_energy);
  json.key("taken_up_J").value(m.taken_up).key("given_back_J").value(m.given_back);
  json.key("lost_J").value(m.damping + m.breaking).close('}');
}

void append_energy(JsonWriter& json, const simulation::Audit& audit, const simulation::Scene& scene) {
  const simulation::EnergyFlows& e = audit.sums.energy;
  json.key("energy").open('{');
  json.key("initial_J").value(audit.sums.initial_energy).key("kinetic_J").value(audit.kinetic_energy);
  json.key("thrust_J").value(e.thrust).key("current_J").value(e.current);
  const simulation::BoundaryFlows& b = audit.sums.boundaries;
  if (has_wind_or_walls(scene)) json.key("wind_J").value(b.wind).key("walls_J").value(b.walls);
  if (has_moorings(scene)) append_stored(json, audit);
  json.key("drag_J").value(e.drag);
  json.key("friction_J").value(e.friction).key("restitution_J").value(e.restitution);
  json.key("crushing_J").value(e.crushing).key("bending_J").value(e.bending);
  json.key("splitting_J").value(e.splitting).key("grinding_J").value(e.grinding);
  json.key("submersion_J").value(e.submersion).key("submerged_ice_J").value(e.submerged_ice);
  json.key("rest_J").value(e.rest);
  json.key("imbalance_J").value(audit.energy_imbalance).key("turnover_J").value(audit.turnover);
  json.close('}');
}

void append_momentum(JsonWriter& json, const simulation::Audit& audit, bool has_boundaries) {
  const auto vector = [&](const char* key, geometry::Vector v) { json.key(key).list(std::array{v.x, v.y}); };
  const simulation::MomentumFlows& m = audit.sums.momentum;
  const simulation::BoundaryFlows& b = audit.sums.boundaries;
  json.key("momentum").open('{');
  vector("initial_Ns", audit.sums.initial_momentum);
  vector("final_Ns", audit.total_momentum);
  vector("thrust_Ns", m.thrust);
  vector("held_Ns", m.held);
  vector("water_Ns", m.water);
  if (has_boundaries) vector("wind_Ns", b.wind_impulse);
  if (has_boundaries) vector("walls_Ns", b.wall_impulse);
  vector("removed_Ns", m.removed);
  vector("imbalance_Ns", audit.momentum_imbalance);
  json.key("turnover_Ns").value(audit.momentum_turnover).close('}');
}

void append(JsonWriter& json, const simulation::Audit& audit, const simulation::Scene& scene) {
  append_energy(json, audit, scene);
  if (has_moorings(scene)) append_moorings(json, audit);
  append_momentum(json, audit, has_wind_or_walls(scene));
  json.key("audit_closed").value(audit.is_closed());
}

void append(JsonWriter& json, const simulation::Counts& counts) {
  json.key("counts").open('{');
  json.key("floes_initial").value(counts.floes_initial).key("floes_final").value(counts.floes_final);
  json.key("bends").value(counts.bends).key("splits").value(counts.splits);
  json.key("ground").value(counts.ground);
  json.key("tilted_under").value(counts.tilted_under).key("went_under").value(counts.went_under);
  json.key("came_up").value(counts.came_up).key("stayed_under").value(counts.stayed_under);
  json.key("crush_contacts").value(counts.crush_contacts).key("rejected_cuts").value(counts.rejected_cuts);
  json.key("database_out_of_range").value(counts.database_out_of_range);
  json.key("floated_cusps").value(counts.floated_cusps).key("brash_pieces").value(counts.brash_pieces);
  json.key("snap_rounded").value(counts.snap_rounded);
  json.key("crowded_ticks").value(counts.crowded_ticks).key("body_steps").value(counts.body_steps);
  json.key("unresolved_splits").value(counts.unresolved_splits);
  json.key("passing_steps").value(counts.passing_steps);
  json.key("unconverged_steps").value(counts.unconverged_steps);
  json.key("largest_left_over_m_per_s").value(counts.largest_residual);
  json.key("energy_created_J").value(counts.energy_created);
  json.key("unpaired_stretches").value(counts.unpaired_stretches);
  json.key("peak_contacts").value(counts.peak_contacts).key("peak_awake").value(counts.peak_awake);
  json.close('}');
}

void append(JsonWriter& json, const simulation::PeakCounts& peaks, double least) {
  json.key("load_peaks").open('{').key("recorded").value(peaks.recorded).key("least_N").value(least);
  json.key("below_least").value(peaks.below).key("beyond_limit").value(peaks.beyond);
  json.key("largest_beyond_limit_N").value(peaks.largest_beyond).close('}');
}

constexpr std::size_t kMostShipContacts = 5;  ///< largest number of such warnings

/// Returns a warning for each pair of ships or structures that came into contact, for the first few pairs.
std::vector<std::string> ship_contact_warnings(const Simulation& simulation) {
  std::vector<std::string> warnings;
  const auto& contacts = simulation.world().accounts.hull_contacts;
  for (const simulation::Event& event : contacts) {
    const auto& c = std::get<simulation::HullContact>(event.what);
    if (warnings.size() == kMostShipContacts) {
      warnings.push_back(fmt::format("{} more pairs of ships and structures came into contact (events.ndjson)",
                                     contacts.size() - kMostShipContacts));
      break;
    }
    warnings.push_back(fmt::format(
        "{} and {} came into contact at {:.6g} s, closing at {:.3g} m/s; {}", hull_name(simulation.scene(), event.ship),
        hull_name(simulation.scene(), c.other), event.time, c.closing_speed,
        c.is_prescribed ? "the motion of both is prescribed, so they pass through each other and no force is "
                          "computed: give the ship thrust_N or an engine"
                        : "forces.csv has these loads apart from those of ice, in its *_from_ships columns"));
  }
  return warnings;
}

void add_mooring_warnings(const Simulation& simulation, std::vector<std::string>& warnings) {
  const auto& ships = simulation.scene().ships;
  const auto& helms = simulation.world().population.helms;
  for (std::size_t i = 0; i < ships.size(); ++i) {
    if (helms[i].is_adrift)
      warnings.push_back(fmt::format(
          "the mooring of {} broke at {:.6g} s, above {:.4g} kN; it is adrift (events.ndjson has the force)",
          ships[i].name, helms[i].adrift_since, 1e-3 * ships[i].mooring->break_load));
  }
}

std::vector<std::string> warnings_of(const Simulation& simulation, const simulation::Counts& counts) {
  std::vector<std::string> warnings = ship_contact_warnings(simulation);
  add_mooring_warnings(simulation, warnings);
  const auto warn = [&](std::int64_t count, std::string_view noun, std::string_view words) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", counted(count, noun), words));
  };
  warn(counts.rejected_cuts, "rejected cut", "in events.ndjson, each with its reason");
  warn(counts.unresolved_splits, "split",
       "did not happen, because their contacts could not be stopped at the splitting force (unresolved_splits)");
  warn(counts.passing_steps, "step",
       "in which more than half of a body was inside another one, because rigid impulses never remove crushed ice "
       "(contact.law crush does); polynya inspect --check names the bodies");
  warn(counts.unconverged_steps, "step",
       "used all sweeps of the contact solver without reaching its tolerance (contact.iterations sets their number)");
  warn(counts.crowded_ticks, "tick",
       "broke more ice in each of their parts than the model allows in a step, so loads depend on the step; give a "
       "shorter "
       "time.step_s");
  warn(counts.database_out_of_range, "cusp",
       simulation.scene().fracture.bending == simulation::BendingModelKind::kFsiDatabase
           ? "broke under a load outside the database's range: the force at which the ice broke and the cusp's radius "
             "are those at the nearest edge of the range, with an unknown error (docs/database.md, \"Outside of the "
             "table\"); polynya database query gives the ranges"
           : "broke under a load outside the range of fracture.bending.model: the force at which the ice broke and the "
             "cusp's radius are those of the formula outside the range for which it was derived "
             "(docs/theory/bending.md)");
  if (const simulation::PeakCounts& peaks = simulation.world().accounts.load_peaks.counts; peaks.beyond > 0)
    warnings.push_back(
        fmt::format("contacts.csv has the first {} peaks of contacts' forces: {} came later, the "
                    "largest of {:.4g} kN; give a larger record.least_peak_N",
                    peaks.recorded, peaks.beyond, 1e-3 * peaks.largest_beyond));
  if (const simulation::Audit audit = simulation.audit(); !audit.is_closed()) {
    warnings.push_back(
        fmt::format("THE AUDIT IS BROKEN: energy is off by {:.2e} J of {:.2e} J, momentum by {:.2e} N s of {:.2e} N s; "
                    "do not trust this run, and please report it with its failure.bin",
                    audit.energy_imbalance, audit.turnover, length(audit.momentum_imbalance), audit.momentum_turnover));
  }
  const simulation::IceLedger areas = simulation.area_ledger(), masses = simulation.mass_ledger();
  if (!areas.is_closed() || !masses.is_closed())
    warnings.push_back(
        fmt::format("THE LEDGER IS BROKEN: ice is off by {:.2e} m2 of {:.2e} m2, {:.2e} kg of {:.2e} kg; do not trust "
                    "this run, and please report it with its failure.bin",
                    areas.imbalance(), areas.initial, masses.imbalance(), masses.initial));
  if (simulation.scene().fracture.characteristic_length == fracture::CharacteristicLength::kAsPrinted)
    warnings.emplace_back("fracture.characteristic_length is as_printed: Eq. (7) with the paper's misprint");
  return warnings;
}

}  // namespace

double shortest_step(const simulation::Counts& counts, double tick) {
  return tick / static_cast<double>(std::max<std::int64_t>(1, counts.most_parts));
}

RunSummary summarise(const Simulation& simulation, const RunWriter& writer, const std::string& stopped_by,
                     double wall_time) {
  RunSummary summary;
  summary.finished = stopped_by.empty();
  summary.stopped_by = stopped_by;
  summary.counts = simulation.counts();
  summary.steps = summary.counts.steps;
  summary.sim_time = simulation.time();
  summary.wall_time = wall_time;
  summary.areas = simulation.area_ledger();
  summary.masses = simulation.mass_ledger();
  summary.audit = simulation.audit();
  summary.peaks = writer.peaks();
  summary.load_peaks = simulation.world().accounts.load_peaks.counts;
  summary.warnings = warnings_of(simulation, summary.counts);
  for (const std::string& name : writer.overlong())
    summary.warnings.push_back(
        fmt::format("{} has more than the {} bytes that inspect, view and the others read; record less (the "
                    "scene's record)",
                    name, kLongestRunFile));
  return summary;
}

namespace {

/// Returns the first value in `found` whose kind differs from that of the value in the same place of `written`. Items
/// of a list are compared with the first item of the list in `written`.
std::optional<JsonFault> other_kind(const JsonValue& found, const JsonValue& written, const std::string& path) {
  if (!found.is(written.kind())) {
    JsonFault fault;
    fault.path = path.empty() ? "the file" : path;
    fault.found = show(found);
    fault.allowed = name_of(written.kind());
    fault.offset = found.offset;
    return fault;
  }
  std::optional<JsonFault> fault;
  if (found.is(JsonValue::Kind::kArray)) {
    for (std::size_t i = 0; i < found.items().size() && !fault && !written.items().empty(); ++i)
      fault = other_kind(found.items()[i], written.items().front(), fmt::format("{}[{}]", path, i));
  } else if (found.is(JsonValue::Kind::kObject)) {
    for (std::size_t i = 0; i < found.members().size() && !fault; ++i) {
      const auto& [key, offset, value] = found.members()[i];
      if (const JsonValue* as_written = written.find(key))
        fault = other_kind(value, *as_written, path.empty() ? key : path + "." + key);
    }
  }
  return fault;
}

}  // namespace

std::optional<JsonFault> fault_of_summary(const JsonValue& summary, const LoadedScene& scene) {
  RunSummary any;
  any.stopped_by = "any";
  any.warnings = {"any"};
  any.peaks.push_back({"any", std::vector<Peak>(peak_columns(scene.scene).size())});
  return other_kind(summary, parse_json(to_json_text(any, scene)).root, "");
}

std::optional<FinishedRun> finished_run(const std::filesystem::path& folder) {
  const auto text = read_text_file(folder / run_file::kSummary, kLongestScene);
  if (!text) return {};
  const JsonDocument summary = parse_json(*text);
  const JsonValue* finished = summary.root.find("finished", JsonValue::Kind::kBoolean);
  if (!summary.faults.empty() || !finished || !finished->boolean()) return {};
  const auto number = [&](std::string_view key) {
    const JsonValue* found = summary.root.find(key, JsonValue::Kind::kNumber);
    return found ? found->number() : 0;
  };
  return FinishedRun{number("sim_time_s"), number("wall_time_s")};
}

std::string_view version() {
  return POLYNYA_VERSION;
}

std::string to_json_text(const RunSummary& summary, const LoadedScene& scene) {
  const auto write = [&](JsonWriter& json) {
    json.key("version").value(version()).key("folder_version").value(kRunFolderVersion);
    json.key("scene").value(scene.scene.name).key("seed").value(scene.scene.seed);
    json.key("scene_hash").value(scene.hash).key("finished").value(summary.finished);
    if (!summary.stopped_by.empty()) json.key("stopped_by").value(summary.stopped_by);
    json.key("step_s").value(scene.scene.time.step);
    json.key("steps").value(summary.steps).key("sim_time_s").value(summary.sim_time);
    json.key("time_steps").value(summary.counts.steps_taken);
    json.key("shortest_step_s").value(shortest_step(summary.counts, scene.scene.time.step));
    json.key("wall_time_s").value(summary.wall_time).key("real_time_factor").value(summary.real_time_factor());
    json.key("forces_interval_s").value(recording_interval(scene.scene));
    const std::vector<const ForceColumn*> columns = peak_columns(scene.scene);
    json.key("peaks").objects(summary.peaks, [&](const ShipPeaks& peaks) { append(json, peaks, columns); });
    append(json, summary.areas, summary.masses);
    json.key("ledger_closed").value(summary.areas.is_closed() && summary.masses.is_closed());
    append_ice_of_floes(json, scene.scene);
    append(json, summary.audit, scene.scene);
    append(json, summary.counts);
    append(json, summary.load_peaks, scene.scene.record.least_peak);
    json.key("warnings").list(summary.warnings);
  };
  return json_object(write, JsonWriter::Layout::kIndented);
}

}  // namespace polynya::io
