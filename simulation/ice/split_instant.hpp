#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Finds the splits that the forces of the solved contacts make, in the order of the pairs of bodies. Finds none unless
/// the scene's splitting rule is SplittingModel::kLefm. `splits` is cleared first.
void find_splits(const Setup& setup, const Step& step, const Population& population,
                 const std::vector<dynamics::Contact>& contacts, std::vector<PendingFracture>& splits);

/// Solves the step's contacts by the law of crushing ice and finds the floes that split. A split happens at the instant
/// at which its opening force reaches its capacity F_max. If the forces between two bodies at the end of the step would
/// open a crack with s F_max, s > 1, the floe has split when these forces had 1/s of their values. The contacts of the
/// two bodies are therefore limited to that fraction of their forces, as contacts are at which ice bends, and the step
/// is solved again from its start. If the limited forces then open the crack with less than F_max, because one contact
/// is unloaded when another one breaks, the fraction is found by bisection. Bends whose contacts a split stopped are
/// removed from StepData::fractures. Returns the result of the last solution; splits whose fraction was not found are
/// counted in Counts::unresolved_splits.
dynamics::SolverResult solve_to_splits(const Setup& setup, const Step& step, Population& population, StepData& data,
                                       Counts& counts);

}  // namespace polynya::simulation
