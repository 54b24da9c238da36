#pragma once

#include <string>

#include "io/run/run_writer.hpp"
#include "io/run/summary.hpp"
#include "simulation/simulation.hpp"

namespace polynya::io {

/// The summary of a run at its end, or where it was stopped; `stopped_by` is empty at the end.
RunSummary summarise(const simulation::Simulation& simulation, const RunWriter& writer,
                     const std::string& stopped_by, double wall_time);

}  // namespace polynya::io
