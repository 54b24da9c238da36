#pragma once

#include <string>

#include "io/run/summary.hpp"

namespace polynya::analysis {

/// What `polynya run` prints at its end: how fast it was, what broke, the ledgers of area, mass and energy, and the
/// largest loads of each ship and structure.
std::string result_text(const io::RunSummary& summary, const simulation::Scene& scene);

}  // namespace polynya::analysis
