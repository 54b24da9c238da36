#include "app/run/memory.hpp"

#include <cmath>

#include <fmt/format.h>

#include "app/command_line/console.hpp"
#include "io/run/run_folder.hpp"
#include "simulation/world/memory_estimate.hpp"

namespace polynya::app {
std::string amount_of_memory(double bytes) {
  return bytes < 1e9 ? fmt::format("{:.0f} MB", bytes / 1e6) : fmt::format("{:.3g} GB", bytes / 1e9);
}

bool may_fit(const simulation::Scene& scene, const std::string& name, const io::MemoryAvailable& available) {
  const simulation::MemoryEstimate needed = simulation::estimate_memory(scene);
  if (needed.at_start > available.bytes) {
    print_err("polynya: {}: {} take at least {} of memory, and there are {} ({}); nothing was written; {}\n", name,
              counted(scene.floes.size(), "floe"), amount_of_memory(needed.at_start), amount_of_memory(available.bytes),
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

void print_folder_size(const simulation::Scene& scene, bool has_final_geojson) {
  if (scene.floes.size() <= io::kMostFloesInFinal) return;
  const io::FolderSize size = io::estimate_folder_size(scene);
  print_err("note: {} begin floes.ndjson with about {}; final.geojson, about {}, {}\n",
            counted(scene.floes.size(), "floe"), amount_of_memory(size.floes), amount_of_memory(size.final_geojson),
            has_final_geojson ? "is written at the end" : "is written only with --final-geojson");
}

std::string out_of_memory() {
  const io::MemoryAvailable available = io::memory_available();
  if (!std::isfinite(available.bytes)) return "out of memory";
  return fmt::format("out of memory: there are {} in all ({})", amount_of_memory(available.bytes), available.source);
}

}  // namespace polynya::app
