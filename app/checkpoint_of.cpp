#include "app/carry_out.hpp"
#include "io/text/version.hpp"

namespace polynya::app {

using simulation::Simulation;

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

}  // namespace polynya::app
