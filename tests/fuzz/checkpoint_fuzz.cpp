// Checkpoints, from anybody. The first byte says how deep to begin: at the file, at its payload behind a
// checksum that is right, or at the state alone. What is read as a state is a world that adds up, and reads
// back as itself.

#include <cstdint>
#include <cstdlib>
#include <string>

#include "checkpoint_scene.hpp"

#include "io/run/checkpoint.hpp"
#include "simulation/simulation.hpp"
#include "simulation/state/state.hpp"

namespace {

using polynya::simulation::Simulation;

void require(bool holds) {
  if (!holds) std::abort();
}

void read_state(const std::string& bytes) {
  const auto simulation = Simulation::resumed(polynya::tests::checkpoint_scene(), bytes);
  if (!simulation) return require(!simulation.error().empty());
  require(!polynya::simulation::validate_world(simulation->world()));
  const auto again = Simulation::resumed(polynya::tests::checkpoint_scene(), simulation->state());
  require(again.has_value() && again->state_hash() == simulation->state_hash());
}

void read_checkpoint(const std::string& bytes) {
  const auto checkpoint = polynya::io::read_checkpoint(bytes);
  if (!checkpoint) return require(!checkpoint.error().empty());
  require(polynya::io::checkpoint_bytes(*checkpoint) == bytes);
  read_state(checkpoint->state);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size == 0 || size > 50000) return 0;
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  switch (data[0] % 3) {
    case 0:
      read_checkpoint(bytes);
      break;
    case 1:
      read_checkpoint(polynya::io::checkpoint_file_of(bytes));
      break;
    default:
      read_state(bytes);
  }
  return 0;
}
