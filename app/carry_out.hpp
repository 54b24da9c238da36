#pragma once

#include "app/exit_code.hpp"
#include "app/run_options.hpp"
#include "io/run/checkpoint.hpp"
#include "io/run/run_writer.hpp"
#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"

namespace polynya::app {

/// A run somewhere between its start and its end.
struct ActiveRun {
  const io::LoadedScene& scene;
  simulation::Simulation simulation;
  io::RunWriter writer;
  double wall_time = 0;  ///< that it has taken before [s]
};

/// Takes a run to its end, or to what stops it; tells how it went. Returns an ExitCode.
int carry_out(ActiveRun run, const CarryOptions& options);

/// Where a run stands between two steps, its journal having been written.
io::Checkpoint checkpoint_of(const simulation::Simulation& simulation, const io::LoadedScene& scene,
                             io::RunProgress progress, double wall_time);

}  // namespace polynya::app
