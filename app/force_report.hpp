#pragma once

#include <string>
#include <vector>

#include "io/run/summary.hpp"
#include "simulation/simulation.hpp"

namespace polynya::app {

/// The largest loads on each ship and structure over a run, in lines for the terminal: the true force first
/// (io/run/shown_loads.hpp).
std::string force_lines(const io::RunSummary& summary, const simulation::Scene& scene);

/// A warning for each two ships or structures that came into contact, the first few of them.
std::vector<std::string> ship_contact_warnings(const simulation::Simulation& simulation);

}  // namespace polynya::app
