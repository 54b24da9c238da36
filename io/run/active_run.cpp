#include "io/run/active_run.hpp"

#include <cmath>

#include <fmt/format.h>

#include "io/run/run_folder.hpp"
#include "io/run/run_loop.hpp"
#include "io/run/summary.hpp"
#include "io/text/output_file.hpp"
#include "simulation/state/validate_world.hpp"

namespace polynya::io {

using simulation::Simulation;

Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite) {
  Simulation simulation(scene.scene);
  auto writer = RunWriter::create(folder, overwrite, scene);
  if (!writer) return fail(writer.error());
  return ActiveRun{scene, std::move(simulation), std::move(*writer)};
}

std::int64_t last_step_of(const simulation::StepSettings& time) {
  return static_cast<std::int64_t>(std::ceil(time.until / time.step - 1e-9));
}

Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file) {
  auto checkpoint = read_checkpoint_file(file, scene.course_hash);
  if (!checkpoint) return fail(checkpoint.error());
  const simulation::StepSettings& time = scene.scene.time;
  if (checkpoint->steps > last_step_of(time))
    return fail(fmt::format("{}: at {:.6g} s, behind the end of the run at {:.6g} s", file.string(),
                            static_cast<double>(checkpoint->steps) * time.step, time.until));
  auto simulation = simulation_at(scene, *checkpoint);
  if (!simulation) return fail(fmt::format("{}: {}", file.string(), simulation.error()));
  const auto finished = finished_run(lock.folder());
  auto writer = RunWriter::resume(std::move(lock), scene, *checkpoint, file, *simulation);
  if (!writer) return fail(writer.error());
  return ActiveRun{scene, std::move(*simulation), std::move(*writer),
                   finished ? finished->wall_time : checkpoint->wall_time};
}

Result<Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint) {
  auto simulation = Simulation::resumed(scene.scene, checkpoint.state);
  if (!simulation) return fail("damaged: " + simulation.error());
  if (simulation->steps() != checkpoint.steps || simulation->state_hash() != checkpoint.state_hash)
    return fail("damaged: its state is not the one that was saved");
  return simulation;
}

Checkpoint checkpoint_of(const Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time) {
  return {.program_version = std::string(version()),
          .course_hash = scene.course_hash,
          .steps = simulation.steps(),
          .wall_time = wall_time,
          .progress = std::move(progress),
          .state = simulation.state(),
          .state_hash = simulation.state_hash(),
          .failure = ""};
}

namespace {

using simulation::Simulation;

/// The run at its newest checkpoint that can be read and is sound, or at its start.
Simulation at_last_checkpoint(const ActiveRun& run) {
  for (const auto& path : checkpoints_in(run.writer.folder())) {
    const auto checkpoint = read_checkpoint_file(path, run.scene.course_hash);
    if (!checkpoint || checkpoint->steps >= run.simulation.steps()) continue;
    auto there = Simulation::resumed(run.scene.scene, checkpoint->state);
    if (there && !failure_after_step(*there)) return std::move(*there);
  }
  return Simulation(run.scene.scene);
}

void step(Simulation& simulation, std::int64_t most_ticks) {
  simulation.step(most_ticks);
  simulation.journal().clear();
}

}  // namespace

std::optional<std::string> failure_after_step(const Simulation& simulation) {
  if (auto failure = simulation.numerical_failure()) return "numerical failure: " + *failure;
  if (!simulation.audit().is_closed()) return "the accounts of energy or momentum do not close";
  if (auto wrong = validate_world(simulation.world())) return "the world contradicts itself: " + *wrong;
  return {};
}

namespace {

Result<> find_and_dump(const ActiveRun& run) {
  Simulation ahead = at_last_checkpoint(run);
  Simulation before = at_last_checkpoint(run);
  std::optional<std::string> failure;
  std::int64_t last = before.steps();  // before the step that fails
  while (!failure && ahead.steps() < run.simulation.steps()) {
    last = ahead.steps();
    step(ahead, last_step_of(run.scene.scene.time) - last);
    failure = failure_after_step(ahead);
  }
  if (!failure) return fail("it did not come again");
  while (before.steps() < last) step(before, last_step_of(run.scene.scene.time) - before.steps());
  before.journal().clear();
  Checkpoint dump = checkpoint_of(before, run.scene, {}, 0);
  dump.failure = *failure;
  return write_whole_file(run.writer.folder() / run_file::kFailure, checkpoint_bytes(dump), Durability::kSynced);
}

}  // namespace

Result<> dump_failure(const ActiveRun& run) {
  return find_and_dump(run);
}

}  // namespace polynya::io
