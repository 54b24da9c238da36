#pragma once

#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// Returns the tick of a scene that does not give one in time.step_s [s]. It is the longest of a list of round numbers
/// from 0.1 s to 0.0005 s (default_tick.cpp) that satisfies three conditions:
///
/// 1. It divides the intervals record.forces_interval and record.frames_interval into whole numbers of ticks.
/// 2. No hull at full speed needs more than a quarter of kMostParts parts (parts.hpp) in 95 % of the ice by area, with
///    the largest speeds of drift, wind drift and floes added. Full speed is the speed at the start, or with an engine
///    the open-water speed if that is larger; under a constant thrust it is at least 4 m/s. That of a pressing wall is
///    its closing speed. A scene without hulls is treated like one with a hull at rest. With the law of impulses, which
///    has no parts, a hull stays within allowed_displacement() of that ice in a tick.
/// 3. No floe at its initial speed moves farther in a tick than that displacement, and no point of its rim farther than
///    kDisplacementOverRadius times ContactSettings::circle_radius, a quarter of it. The drift of other ice is added to
///    the speed of fast ice.
///
/// If no number of the list satisfies all three, the first condition is ignored; if none satisfies the other two, the
/// tick is the smallest number. The tick does not depend on the end of the run, so that a run that is ended early and
/// resumed is the same run.
double default_tick(const Scene& scene);

/// Returns the tick without the first condition, for comparison only [s]. It is longer than default_tick() only if an
/// interval requires a short tick. If it is at least 2.5 times as long, the check of a scene gives a hint that another
/// interval would make the run faster.
double tick_for_any_interval(const Scene& scene);

}  // namespace polynya::simulation
