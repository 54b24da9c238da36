#pragma once

#include <string>

#include "io/run/summary.hpp"
#include "simulation/scene.hpp"

namespace polynya::app {

/// The largest loads on each ship and structure over a run, in lines for the terminal: the true force first
/// (io/run/shown_loads.hpp).
std::string force_lines(const io::RunSummary& summary, const simulation::Scene& scene);

}  // namespace polynya::app
