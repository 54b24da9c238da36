#include "app/failure_dump.hpp"

#include <fmt/format.h>

#include "io/output_file.hpp"
#include "io/run_folder.hpp"

namespace polynya::app {
namespace {

using simulation::Simulation;

/// The run at its newest checkpoint that can be read, or at its start.
Simulation at_last_checkpoint(const RunInHand& run) {
  for (const auto& path : io::checkpoints_in(run.writer.folder())) {
    const auto checkpoint = io::read_checkpoint_file(path, run.scene.hash);
    if (!checkpoint || checkpoint->steps >= run.simulation.steps()) continue;
    if (auto there = Simulation::resumed(run.scene.scene, checkpoint->state)) return std::move(*there);
  }
  return Simulation(run.scene.scene);
}

}  // namespace

std::string dump_failure(const RunInHand& run, const std::string& reason) {
  Simulation before = at_last_checkpoint(run);
  while (before.steps() + 1 < run.simulation.steps() && !before.numerical_failure()) {
    before.step();
    before.journal().clear();
  }
  if (before.numerical_failure()) return "it did not come again at the same step";
  before.journal().clear();
  io::Checkpoint dump = checkpoint_of(before, run.scene, {}, 0);
  dump.failure = reason;
  return write_whole_file(run.writer.folder() / io::run_file::kFailure, checkpoint_bytes(dump),
                          io::Durability::kSynced);
}

}  // namespace polynya::app
