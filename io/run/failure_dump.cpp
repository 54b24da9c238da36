#include "io/run/failure_dump.hpp"

#include "io/run/run_folder.hpp"
#include "io/run/run_loop.hpp"
#include "io/text/output_file.hpp"
#include "simulation/state/validate_world.hpp"

namespace polynya::io {
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
