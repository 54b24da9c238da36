#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <fmt/format.h>

#include "app/commands.hpp"
#include "app/exit_code.hpp"
#include "app/load_scene.hpp"
#include "app/stop_signal.hpp"
#include "app/tell.hpp"
#include "io/run_folder.hpp"
#include "io/run_writer.hpp"
#include "simulation/simulation.hpp"

namespace polynya::app {
namespace {

using simulation::Simulation;

std::string signal_name(int signal) {
  return signal == 2 ? "SIGINT" : signal == 15 ? "SIGTERM" : fmt::format("signal {}", signal);
}

/// Steps the simulation to its end, or to what stops it, which is returned.
struct Stop {
  ExitCode code = kDone;
  std::string reason;
};

Stop advance(Simulation& simulation, io::RunWriter& writer, Progress& progress) {
  const simulation::Scene& scene = simulation.scene();
  const auto steps = static_cast<long long>(std::ceil(scene.time.until / scene.time.step - 1e-9));
  const auto steps_per_frame = std::max(1LL, std::llround(scene.record.frames_interval / scene.time.step));
  long long fractures = 0;
  writer.record(simulation.journal());
  writer.frame(simulation);
  for (long long step = 1; step <= steps; ++step) {
    simulation.step();
    fractures += static_cast<long long>(simulation.journal().events.size());
    writer.record(simulation.journal());
    if (auto failure = simulation.numerical_failure())
      return {kNumericalFailure, "numerical failure: " + *failure};
    if (step % steps_per_frame == 0 || step == steps) writer.frame(simulation);
    if (const int signal = stop_signal()) return {kStopped, signal_name(signal)};
    if (step % 64 != 0) continue;
    writer.flush_if_due();
    if (std::string failure = writer.failure(); !failure.empty()) return {kInputOutput, failure};
    progress.show(simulation.time(), fractures);
  }
  return {};
}

std::vector<std::string> warnings_of(const Simulation& simulation, const simulation::Counts& counts) {
  std::vector<std::string> warnings;
  const auto warn = [&](std::int64_t count, const char* words) {
    if (count > 0) warnings.push_back(fmt::format("{} {}", count, words));
  };
  warn(counts.rejected_cuts, "cuts were rejected; events.ndjson has each with its reason");
  warn(counts.unconverged_steps, "steps used all sweeps of the impulse solver (contact.iterations)");
  warn(counts.database_out_of_range, "bending loads lay outside the database's range");
  warn(counts.kept_exact, "shapes had to stay in rationals; their rings in floes.ndjson are nearest doubles");
  if (const simulation::Audit audit = simulation.audit(); !audit.is_closed()) {
    warnings.push_back(fmt::format(
        "THE AUDIT IS BROKEN: energy is off by {:.2e} J of {:.2e} J, momentum by {:.2e} N s of {:.2e} N s; "
        "do not "
        "trust this run, and please report it",
        audit.energy_imbalance, audit.turnover, length(audit.momentum_imbalance), audit.momentum_turnover));
  }
  if (simulation.scene().fracture.characteristic_length == fracture::CharacteristicLength::kAsPrinted)
    warnings.emplace_back("fracture.characteristic_length is as_printed: Eq. (7) with the paper's misprint");
  return warnings;
}

io::RunSummary summarise(const Simulation& simulation, const io::RunWriter& writer, const Stop& stop,
                         double wall_time) {
  io::RunSummary summary;
  summary.finished = stop.code == kDone;
  summary.stopped_by = stop.reason;
  summary.counts = simulation.counts();
  summary.steps = summary.counts.steps;
  summary.sim_time = simulation.time();
  summary.wall_time = wall_time;
  summary.ledger = simulation.area_ledger();
  summary.audit = simulation.audit();
  summary.peaks = writer.peaks();
  summary.warnings = warnings_of(simulation, summary.counts);
  return summary;
}

void print_result(const io::RunSummary& summary, const io::RunWriter& writer) {
  const auto& counts = summary.counts;
  const auto& ledger = summary.ledger;
  fmt::print("simulated   {:.6g} s in {:.3g} s, {:.3g} x real time\n", summary.sim_time, summary.wall_time,
             summary.real_time_factor());
  fmt::print("fractures   {} cusps broken by bending, {} splits, {} rejected cuts\n", counts.bends,
             counts.splits, counts.rejected_cuts);
  fmt::print("floes       {} -> {}\n", counts.floes_initial, counts.floes_final);
  fmt::print(
      "ice         {:.6f} m2 = {:.6f} floes + {:.6f} submerged + {:.6f} brash (imbalance {:.1e}, rounding "
      "{:.1e} m2)\n",
      ledger.initial_ice_area, ledger.floe_area, ledger.submerged_area, ledger.brash_area, ledger.imbalance,
      ledger.rounding_defect);
  const simulation::EnergyFlows& energy = summary.audit.sums.energy;
  fmt::print(
      "energy      {:.4g} kJ in: {:.4g} drag, {:.4g} friction, {:.4g} crushing, {:.4g} collisions, {:.4g} in "
      "motion "
      "(imbalance {:.1e} of it)\n",
      (energy.thrust + energy.current + summary.audit.sums.initial_energy) / 1e3, energy.drag / 1e3,
      energy.friction / 1e3, energy.crushing / 1e3, energy.restitution / 1e3,
      summary.audit.kinetic_energy / 1e3,
      summary.audit.energy_imbalance / std::max(summary.audit.turnover, 1e-300));
  for (const io::ShipPeaks& peaks : summary.peaks) {
    fmt::print(
        "peak force  {}: surge {:.4g} kN at {:.6g} s, sway {:.4g} kN at {:.6g} s (the paper's j/tau_c)\n",
        peaks.ship, peaks.surge_peak.value / 1e3, peaks.surge_peak.time, peaks.sway_peak.value / 1e3,
        peaks.sway_peak.time);
  }
  fmt::print("run folder  {}\n", writer.folder().string());
  const auto picture =
      writer.folder() / (writer.has_png() ? io::run_file::kFinalPng : io::run_file::kFinalSvg);
  fmt::print("picture     {}\n", picture.string());
  std::fflush(stdout);
}

}  // namespace

int run(const RunOptions& options) {
  const auto loaded = load_scene(options.scene, {.until = options.until, .seed = options.seed});
  if (!loaded) return loaded.error();
  const std::filesystem::path folder = options.out.empty()
                                           ? std::filesystem::path("runs") / loaded->scene.name
                                           : std::filesystem::path(options.out);
  watch_signals();
  auto writer = io::RunWriter::create(folder, options.overwrite, *loaded);
  if (!writer) {
    tell("polynya: {}\n", writer.error());
    return kInputOutput;
  }
  Progress progress(options.progress, loaded->scene.time.until);
  Simulation simulation(loaded->scene);
  Stop stop = advance(simulation, *writer, progress);
  io::RunSummary summary = summarise(simulation, *writer, stop, progress.wall_time());
  progress.finish(summary.sim_time,
                  summary.counts.bends + summary.counts.splits + summary.counts.rejected_cuts);
  if (const std::string failure = writer->finish(summary, simulation); !failure.empty())
    stop = {kInputOutput, failure};
  if (stop.code != kDone) {
    tell("polynya: stopped at {:.6g} s: {}\n", summary.sim_time, stop.reason);
    tell("polynya: {} holds the run up to there; it cannot be resumed\n", folder.string());
  }
  for (const std::string& warning : summary.warnings) tell("note: {}\n", warning);
  if (stop.code != kInputOutput) print_result(summary, *writer);
  return stop.code;
}

}  // namespace polynya::app
