#include "app/carry_out.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <optional>

#include <fmt/format.h>

#include "app/console.hpp"
#include "app/failure_dump.hpp"
#include "app/force_report.hpp"
#include "app/stop_signal.hpp"
#include "io/final_map.hpp"
#include "io/run_folder.hpp"
#include "io/version.hpp"
#include "simulation/world.hpp"

namespace polynya::app {
namespace {

using simulation::Simulation;
using Clock = std::chrono::steady_clock;

std::string signal_name(int signal) {
  return signal == 2 ? "SIGINT" : signal == 15 ? "SIGTERM" : fmt::format("signal {}", signal);
}

/// How a run ended, or what stopped it.
struct Stop {
  ExitCode code = kDone;
  std::string reason;
};

/// Carries a run from where it is to its end, writing as it goes.
class Carrier {
 public:
  Carrier(RunInHand& run, const CarryOptions& options, Progress& progress)
      : run_(run), options_(options), progress_(progress), last_checkpoint_(Clock::now()) {
    const simulation::StepSettings& time = simulation().scene().time;
    const simulation::RecordSettings& record = simulation().scene().record;
    last_step_ = static_cast<std::int64_t>(std::ceil(time.until / time.step - 1e-9));
    steps_per_frame_ = std::max<std::int64_t>(1, std::llround(record.frames_interval / time.step));
    if (options.checkpoint_every > 0)
      steps_per_checkpoint_ = std::max<std::int64_t>(1, std::llround(options.checkpoint_every / time.step));
  }

  Stop advance() {
    std::int64_t step = simulation().steps();
    if (step == 0) {
      writer().record(simulation().journal());
      writer().frame(simulation());
    }
    while (step < last_step_) {
      simulation().step();
      ++step;
      writer().record(simulation().journal());
      if (auto failure = failure_of_step()) return {kNumericalFailure, *failure};
      if (step % steps_per_frame_ == 0 || step == last_step_) writer().frame(simulation());
      if (const int signal = stop_signal()) return stop_on(signal);
      if (Stop stop = look_around(step); stop.code != kDone) return stop;
    }
    return {};
  }

 private:
  Simulation& simulation() { return run_.simulation; }
  io::RunWriter& writer() { return run_.writer; }

  std::optional<std::string> failure_of_step() {
    if (options_.check) return failure_after_step(simulation());
    if (auto failure = simulation().numerical_failure()) return "numerical failure: " + *failure;
    return {};
  }

  Stop stop_on(int signal) {
    if (Stop stop = checkpoint(); stop.code != kDone) return stop;
    return {kStopped, signal_name(signal)};
  }

  /// What is done now and then.
  Stop look_around(std::int64_t step) {
    if (steps_per_checkpoint_ > 0 && step % steps_per_checkpoint_ == 0) return checkpoint();
    if (step % 16 != 0) return {};
    if (options_.checkpoint_every_wall > 0 &&
        seconds_since(last_checkpoint_) >= options_.checkpoint_every_wall)
      return checkpoint();
    writer().flush_if_due();
    if (std::string failure = writer().failure(); !failure.empty()) return {kInputOutput, failure};
    const simulation::Counts& counts = simulation().world().counts;
    progress_.show(simulation().time(), counts.bends + counts.splits + counts.rejected_cuts);
    return {};
  }

  static double seconds_since(Clock::time_point then) {
    return std::chrono::duration<double>(Clock::now() - then).count();
  }

  Stop checkpoint() {
    const io::RunProgress where = writer().sync();
    std::string failure = writer().failure();
    if (failure.empty())
      failure = io::write_checkpoint(
          writer().folder(),
          checkpoint_of(simulation(), run_.scene, where, run_.wall_time + progress_.wall_time()));
    last_checkpoint_ = Clock::now();
    if (!failure.empty()) return {kInputOutput, failure};
    return {};
  }

  RunInHand& run_;
  const CarryOptions& options_;
  Progress& progress_;
  std::int64_t last_step_ = 0;
  std::int64_t steps_per_frame_ = 1;
  std::int64_t steps_per_checkpoint_ = 0;
  Clock::time_point last_checkpoint_;
};

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

/// What dump_failure() said.
void report_dump(const std::string& folder, const std::string& wrong) {
  if (wrong.empty()) {
    print_err(
        "polynya: the state before the step that failed is in failure.bin: polynya resume {} "
        "--from-failure\n",
        folder);
  } else {
    print_err("polynya: the failure could not be dumped: {}\n", wrong);
  }
}

/// What the reader of stderr is to do about it.
void report_stop(const RunInHand& run, const Stop& stop, double sim_time) {
  const std::string folder = run.writer.folder().string();
  print_err("polynya: stopped at {:.6g} s: {}\n", sim_time, stop.reason);
  if (run.writer.is_displaced()) {
    print_err(
        "polynya: the run is lost unless its folder is elsewhere now, with all its files; resume it there\n");
  } else if (stop.code == kNumericalFailure) {
    print_err("polynya: {} holds the run up to there\n", folder);
  } else if (stop.code == kInputOutput) {
    print_err("polynya: once that is put right, go on with: polynya resume {}\n", folder);
  } else {
    print_err("polynya: go on with: polynya resume {}\n", folder);
  }
}

/// Draws the run's map and returns its name; empty where the folder cannot be read back, or the map not
/// written, which is a failure of the run's output.
std::string draw(const std::filesystem::path& folder, Stop& stop) {
  const auto run = io::read_run(folder);
  if (!run) print_err("note: no map is drawn: {}\n", run.error());
  if (!run) return "";
  auto drawn = io::draw_final_map(*run);
  if (drawn) return *drawn;
  stop = {kInputOutput, drawn.error()};
  return "";
}

}  // namespace

io::Checkpoint checkpoint_of(const Simulation& simulation, const io::LoadedScene& scene,
                             io::RunProgress progress, double wall_time) {
  io::Checkpoint checkpoint;
  checkpoint.program_version = io::version();
  checkpoint.scene_hash = scene.hash;
  checkpoint.steps = simulation.steps();
  checkpoint.wall_time = wall_time;
  checkpoint.progress = std::move(progress);
  checkpoint.state = simulation.state();
  checkpoint.state_hash = simulation.state_hash();
  return checkpoint;
}

int carry_out(RunInHand run, const CarryOptions& options) {
  run.simulation.set_threads(options.threads);
  Progress progress(options.progress, run.scene.scene.time.until);
  Stop stop = Carrier(run, options, progress).advance();
  const io::RunSummary summary =
      summarise(run.simulation, run.writer, stop, run.wall_time + progress.wall_time());
  progress.finish(summary.sim_time,
                  summary.counts.bends + summary.counts.splits + summary.counts.rejected_cuts);
  // Before the run is finished: that takes away the checkpoints from which the failure is sought.
  std::optional<std::string> dumped;
  const bool is_to_be_dumped = stop.code == kNumericalFailure || !summary.audit.is_closed();
  if (is_to_be_dumped && !run.writer.is_displaced()) dumped = dump_failure(run);
  if (const std::string failure = run.writer.finish(summary, run.simulation); !failure.empty())
    stop = {kInputOutput, failure};
  const std::string picture = stop.code == kInputOutput ? "" : draw(run.writer.folder(), stop);
  if (stop.code != kDone) report_stop(run, stop, summary.sim_time);
  if (dumped) report_dump(run.writer.folder().string(), *dumped);
  for (const std::string& warning : summary.warnings) print_err("note: {}\n", warning);
  if (stop.code != kInputOutput) print_result(summary, run.scene.scene, run.writer.folder(), picture);
  return stop.code;
}

}  // namespace polynya::app
