#pragma once

#include <optional>
#include <string>

#include "io/run/active_run.hpp"

namespace polynya::io {

/// What is wrong with a run after a step: numbers that are none, accounts that do not close, a world that
/// contradicts itself. Nothing where all is well.
std::optional<std::string> failure_after_step(const simulation::Simulation& simulation);

/// Writes the state before the first step after which something is wrong into the run folder, with what it
/// is. The step is found by stepping again from the newest sound checkpoint, which costs nothing where
/// nothing fails.
Result<> dump_failure(const ActiveRun& run);

}  // namespace polynya::io
