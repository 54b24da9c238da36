#pragma once

#include <string>

#include "app/carry_out.hpp"

namespace polynya::app {

/// Writes the state before the step that failed into the run folder, with what went wrong in that step. It is
/// found by going over the way from the newest checkpoint once more, which costs nothing where nothing fails.
/// Returns what went wrong with that; empty where all is well.
std::string dump_failure(const RunInHand& run, const std::string& reason);

}  // namespace polynya::app
