// Writes the seeds of checkpoint_fuzz into a folder: run it again when kCheckpointVersion rises.
//   build/dev/tests/fuzz/checkpoint_corpus tests/fuzz/checkpoint_fuzz_corpus

#include <fstream>
#include <string>

#include "checkpoint_scene.hpp"

#include "io/run/checkpoint.hpp"
#include "simulation/simulation.hpp"

int main(int count, char** words) {
  if (count != 2) return 2;
  const std::string folder = words[1];
  polynya::simulation::Simulation simulation(polynya::tests::checkpoint_scene());
  simulation.journal().clear();
  const auto write = [&](const std::string& name, char depth, const std::string& bytes) {
    std::ofstream(folder + "/" + name, std::ios::binary) << depth << bytes;
  };
  for (const int until : {0, 20, 60, 150, 400, 1200}) {
    while (simulation.steps() < until) {
      simulation.step();
      simulation.journal().clear();
    }
    polynya::io::Checkpoint checkpoint;
    checkpoint.program_version = "seed";
    checkpoint.course_hash = "0123456789abcdef";
    checkpoint.steps = until;
    checkpoint.progress.files = {{1, 1}, {2, 2}, {3, 3}, {4, 4}, {5, 5}, {6, 6}};
    checkpoint.progress.recorded = {{0, {}}, {}};
    checkpoint.progress.peaks = {{.ship = "ship"}};
    checkpoint.state = simulation.state();
    checkpoint.state_hash = simulation.state_hash();
    const std::string file = polynya::io::checkpoint_bytes(checkpoint);
    const std::string at = std::to_string(until);
    write("state_" + at, 2, checkpoint.state);
    if (until == 60) write("file_" + at, 0, file);
    if (until == 60) write("payload_" + at, 1, file.substr(polynya::io::checkpoint_file_of("").size()));
  }
  return simulation.counts().came_up > 0 ? 0 : 1;
}
