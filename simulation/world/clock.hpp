#pragma once

#include <cstdint>

#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// An instant of a run, and where the water frame is then.
struct Instant {
  double time = 0;         ///< [s]
  geometry::Vector drift;  ///< displacement of the water frame over ground since the start [m]
};

/// One time step. It is made once (step_of, step.hpp) and handed to every stage unchanged: a tick, or one of the
/// equal parts of a tick. All awake bodies take the same step.
struct Step {
  Instant begin;
  Instant end;
  double length = 0;                ///< Δt [s]
  std::int64_t whole_ticks = 0;     ///< that have passed at its end
  geometry::Vector water_velocity;  ///< mean velocity of the water frame over ground in the step [m/s]
  int threads = 1;                  ///< number of threads that compute it; results do not depend on it
};

/// How far a run has come: always a whole number of ticks.
struct Clock {
  std::int64_t ticks = 0;
  double tick = 0;  ///< Scene::time.step [s]

  double time() const { return static_cast<double>(ticks) * tick; }  ///< [s]
};

/// Returns true if a multiple of an interval [s] lies in the tick that the clock has just completed. So an instant that
/// a scene asks for, as for a frame, is rounded up to a whole tick; no step is made shorter for it.
bool is_due(const Clock& clock, double interval);

}  // namespace polynya::simulation
