#pragma once

#include <filesystem>
#include <string>

#include "io/run/run_writer.hpp"
#include "io/run/summary.hpp"
#include "simulation/simulation.hpp"

namespace polynya::app {

/// What summary.json says of a run at its end, or where it was stopped; `stopped_by` is empty at the end.
io::RunSummary summarise(const simulation::Simulation& simulation, const io::RunWriter& writer,
                         const std::string& stopped_by, double wall_time);

/// The same in some lines, on stdout.
/// `picture` is the final map's file in the folder; empty where there is none.
void print_result(const io::RunSummary& summary, const simulation::Scene& scene,
                  const std::filesystem::path& folder, const std::string& picture);

}  // namespace polynya::app
