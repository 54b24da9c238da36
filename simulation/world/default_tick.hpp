#pragma once

#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// The tick of a scene that gives none [s]: the longest of a list of round numbers that goes a whole number of times
/// into the intervals of its records, and in which no hull needs more than a quarter of the most parts at its full
/// speed through the thinnest ice, and no floe moves too far at its first speed. It does not depend on when the run
/// ends, so that a run which is ended early and resumed is the same run. By the law of impulses, which has no parts, a
/// hull stays within most_way() (parts.hpp) in a tick.
double default_tick(const Scene& scene);

/// Returns the same for records of any interval [s]: default_tick() is shorter only where an interval asks for it.
double tick_for_any_interval(const Scene& scene);

}  // namespace polynya::simulation
