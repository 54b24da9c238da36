#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "io/run/checkpoint.hpp"
#include "io/run/run_writer.hpp"
#include "io/scene/scene_reader.hpp"
#include "io/text/result.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {

/// A run somewhere between its start and its end, and its folder.
struct ActiveRun {
  const LoadedScene& scene;  ///< outlives this
  simulation::Simulation simulation;
  RunWriter writer;
  double wall_time = 0;  ///< that it has taken before [s]
};

/// The step that a run ends with.
std::int64_t last_step_of(const simulation::StepSettings& time);

/// A run before its first step. The error is what is wrong with the folder (RunWriter::create).
Result<ActiveRun> start_run(const std::filesystem::path& folder, const LoadedScene& scene, bool overwrite = false);

/// A run at a checkpoint of its folder, read from `file`: the folder is cut back to it (RunWriter::resume), and
/// becomes that of a run to the scene's end, which may be another than it had.
Result<ActiveRun> resume_run(RunLock lock, const LoadedScene& scene, const std::filesystem::path& file);

/// The simulation of a checkpoint, checked against the hash it was saved with.
Result<simulation::Simulation> simulation_at(const LoadedScene& scene, const Checkpoint& checkpoint);

/// Where a run stands between two steps, its journal having been written.
Checkpoint checkpoint_of(const simulation::Simulation& simulation, const LoadedScene& scene, RunProgress progress,
                         double wall_time);

/// What is wrong with a run after a step: numbers that are none, accounts that do not close, a world that
/// contradicts itself. Nothing where all is well.
std::optional<std::string> failure_after_step(const simulation::Simulation& simulation);

/// Writes the state before the first step after which something is wrong into the run folder, with what it
/// is. The step is found by stepping again from the newest sound checkpoint, which costs nothing where
/// nothing fails.
Result<> dump_failure(const ActiveRun& run);

}  // namespace polynya::io
