#pragma once

#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Enters among the splits the floes below κ l that the forces of solved contacts break across as beams, by floe. By
/// all bodies that press a floe together: those that it lies on bear as well.
void find_broken_beams(const Setup& setup, const Population& population, StepData& step);

}  // namespace polynya::simulation
