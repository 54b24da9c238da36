#pragma once

#include <filesystem>
#include <string>

#include "io/run/summary.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::app {

/// A run's summary in some lines, on stdout. `picture` is the final map's file in the folder; empty where
/// there is none.
void print_result(const io::RunSummary& summary, const simulation::Scene& scene,
                  const std::filesystem::path& folder, const std::string& picture);

}  // namespace polynya::app
