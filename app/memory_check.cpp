#include "app/memory_check.hpp"

#include <cmath>

#include "app/console.hpp"
#include "simulation/memory_estimate.hpp"

namespace polynya::app {

bool may_fit(const simulation::Scene& scene, const std::string& name, const MemoryAvailable& available) {
  const simulation::MemoryEstimate needed = simulation::estimate_memory(scene);
  if (needed.at_start > available.bytes) {
    print_err(
        "polynya: {}: {} floes take at least {} of memory, and there are {} ({}); nothing was written; {}\n",
        name, scene.floes.size(), amount_of_memory(needed.at_start), amount_of_memory(available.bytes),
        available.source, kToNeedLessMemory);
    return false;
  }
  if (needed.all_moving > available.bytes) {
    print_err(
        "note: {}: the run takes about {} of memory if all floes come to move and touch, and there are {} "
        "({})\n",
        name, amount_of_memory(needed.all_moving), amount_of_memory(available.bytes), available.source);
  }
  return true;
}

std::string out_of_memory() {
  const MemoryAvailable available = memory_available();
  if (!std::isfinite(available.bytes)) return "out of memory";
  return fmt::format("out of memory: there are {} in all ({})", amount_of_memory(available.bytes),
                     available.source);
}

}  // namespace polynya::app
