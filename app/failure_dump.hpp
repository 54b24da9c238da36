#pragma once

#include <optional>
#include <string>

#include "app/carry_out.hpp"

namespace polynya::app {

/// What is wrong with a run after a step: numbers that are none, accounts that do not close, a world that
/// contradicts itself. Nothing where all is well.
std::optional<std::string> failure_after_step(const simulation::Simulation& simulation);

/// Writes the state before the first step after which something is wrong into the run folder, with what it
/// is. It is found by going over the way from the newest sound checkpoint once more, which costs nothing
/// where nothing fails. Returns what went wrong with that; empty where all is well.
std::string dump_failure(const ActiveRun& run);

}  // namespace polynya::app
