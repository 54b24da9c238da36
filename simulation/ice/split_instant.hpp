#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// The splits that the forces of solved contacts would make, by the order of the pairs. By `lefm` only.
void find_splits(const Setup& setup, const Step& step, const Population& population,
                 const std::vector<dynamics::Contact>& contacts, std::vector<PendingFracture>& splits);

/// Solves the step's contacts by the law of crushing ice and finds its splits, each of them at the instant
/// at which its force comes to F_max: where the forces of two bodies would open a crack with s F_max, they
/// came to F_max at 1/s of themselves. There the contacts of the two break, as they do where ice bends, and
/// the step is solved again from its start; where their forces then fall short of F_max, since one lets go as
/// another breaks, the share is found by bisection.
dynamics::SolverResult solve_to_splits(const Setup& setup, const Step& step, Population& population, StepData& data,
                                       Counts& counts);

}  // namespace polynya::simulation
