#pragma once

#include <string>

#include "analysis/floe_sizes.hpp"
#include "analysis/run_check.hpp"

namespace polynya::analysis {

// What is measured in a run, as `polynya inspect` prints it: for people, and as JSON (docs/inspect.md).

std::string to_text(const RunCheck& check, const simulation::Scene& scene);
std::string to_json_text(const RunCheck& check, const simulation::Scene& scene);

std::string to_text(const SizeDistribution& sizes);
std::string to_json_text(const SizeDistribution& sizes);

}  // namespace polynya::analysis
