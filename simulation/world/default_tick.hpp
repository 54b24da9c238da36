#pragma once

#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// Returns the tick of a scene that does not give one [s]. It is the longest of a list of round numbers that satisfies
/// three conditions. It divides the intervals of the forces and of the frames into whole numbers of ticks. No hull at
/// full speed (its speed at the start, or with an engine the open-water speed if that is larger; at least 4 m/s under a
/// constant thrust) needs more than a quarter of kMostParts parts in 95 % of the ice by area; with the law of impulses,
/// which has no parts, a hull stays within allowed_displacement() (parts.hpp) of that ice in a tick. No floe at its
/// initial speed moves farther in a tick than that displacement, and no point of its rim farther than a quarter of the
/// contact circles' radius. If no number of the list satisfies all three, the intervals are ignored; if none satisfies
/// the other two, the tick is the smallest number. The tick does not depend on the end of the run, so that a run that
/// is ended early and resumed is the same run.
double default_tick(const Scene& scene);

/// Returns the tick without the condition on the intervals of forces and frames [s]. It is longer than default_tick()
/// only if an interval requires a short tick. From a factor of 2.5 on, the check of a scene gives a hint.
double tick_for_any_interval(const Scene& scene);

}  // namespace polynya::simulation
