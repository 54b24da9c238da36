#pragma once

#include <cstdint>

#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// An instant of a run, and the position of the water frame at that time. Positions and velocities of bodies are in the
/// water frame. The frame moves over ground with the drift and tide of the water, without the sheared current; it never
/// turns.
struct Instant {
  double time = 0;         ///< time since the start of the run [s]
  geometry::Vector drift;  ///< displacement of the water frame over ground since the start [m]
};

/// One time step: a tick, or one of the equal parts of a tick. It is made once (step_of, step.hpp), and every stage
/// receives it unchanged. All awake bodies take the same step.
struct Step {
  Instant begin;
  Instant end;
  double length = 0;  ///< length Δt [s]
  /// Number of whole ticks of the run that are completed at its end; all parts of a tick but the last have the same
  /// number. It is a part of the seed with which the places are drawn where ice surfaces (ice/under_hull.cpp), so that
  /// a resumed run draws the same places.
  std::int64_t whole_ticks = 0;
  geometry::Vector water_velocity;  ///< mean velocity of the water frame over ground in the step [m/s]
  int threads = 1;                  ///< number of threads that compute it; results do not depend on it
};

/// The progress of a run, which is always a whole number of ticks.
struct Clock {
  /// Number of ticks so far.
  std::int64_t ticks = 0;
  double tick = 0;  ///< length of a tick, Scene::time.step [s]

  double time() const { return static_cast<double>(ticks) * tick; }  ///< time since the start of the run [s]
};

/// Returns true if a multiple of an interval [s] lies in the tick that the clock has just completed. An instant that a
/// scene asks for, for example of a frame, is therefore rounded up to the end of a tick; no step is made shorter for
/// it. An interval that is shorter than a tick is due in every tick. The start of a run is never due; its frame is
/// written separately.
bool is_due(const Clock& clock, double interval);

}  // namespace polynya::simulation
