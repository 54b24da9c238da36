// How a ship rams ice that stops it: ahead until it is stuck, astern for a length, and ahead again on the same line.
#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"
#include "simulation/ship/pilot.hpp"

namespace polynya::simulation {
namespace {

/// Returns true if the ship has stood still for so long, with its lever at the order, that another order is needed. A
/// ship that still moves because of its previous order is not stuck, and neither is one whose lever is still moving.
bool is_stuck(const RammingPilot& pilot, double ordered, const PilotView& view, PilotMemory& memory) {
  // Difference of the lever from its order that counts as none, because of rounding [-].
  constexpr double kAtOrder = 1e-6;
  const bool stands = std::abs(view.speed_over_ground) <= pilot.stuck_speed;
  if (!stands || std::abs(view.lever - ordered) > kAtOrder) memory.slow_since = view.time;
  return view.time - memory.slow_since >= pilot.stuck_time;
}

/// Orders the engine astern, and stores where the ship is stuck.
void turn_astern(const PilotView& view, PilotMemory& memory) {
  memory.is_backing = true;
  memory.stuck_at = view.own().position_in_world;
  if (memory.rams == 0) memory.first_stuck_at = memory.stuck_at;
}

/// Returns the distance that the ship still goes astern if the engine is ordered ahead now [m]. The lever moves at its
/// rate, and the thrust and the resistance of open water stop the ship. Returns 0 if the engine or the mass is unknown.
double distance_to_stop(const PilotView& view, double lever_ahead) {
  // Time step of the prediction [s]; with a larger one the ship may back by up to a step's distance too far or too
  // little.
  constexpr double kStep = 0.5;
  // Longest time of the prediction [s], which ends it for an engine that hardly pushes.
  constexpr double kLongest = 1200;
  const dynamics::Engine& engine = view.engine;
  if (view.mass <= 0 || engine.bollard_pull <= 0 || engine.open_water_speed <= 0) return 0;
  double speed = view.speed_over_ground, lever = view.lever, distance = 0;
  for (double time = 0; time < kLongest && speed < 0; time += kStep) {
    lever = dynamics::approach(lever, lever_ahead, engine.lever_rate, kStep);
    speed += kStep * dynamics::net_thrust(engine, lever, speed) / view.mass;
    distance -= kStep * std::min(speed, 0.0);
  }
  return distance;
}

/// Returns true if the ship, ordered ahead now, stops where it has backed far enough.
bool has_backed(const RammingPilot& pilot, double heading, const PilotView& view, const PilotMemory& memory) {
  const double wanted = pilot.back_distance > 0 ? pilot.back_distance : view.own().length;
  const double backed = dot(memory.stuck_at - view.own().position_in_world, unit(heading));
  return backed + distance_to_stop(view, pilot.lever_ahead) >= wanted;
}

/// Orders the engine ahead, and counts the charge.
void turn_ahead(PilotMemory& memory) {
  memory.is_backing = false;
  ++memory.rams;
}

/// Returns the heading that leads back to the line on which the ship was last stuck, so that it charges in the channel
/// that it has broken. Astern it is the line's own.
double heading_on_line(double heading, const PilotView& view, const PilotMemory& memory) {
  // Distance ahead on the line towards which the ship steers, in ship lengths [-]; with a smaller one it turns sharply
  // to the line.
  constexpr double kLookAheadOnLine = 1.5;
  if (memory.is_backing) return heading;
  const geometry::Point on_line = memory.rams > 0 ? memory.stuck_at : memory.from;
  const double offset = cross(unit(heading), view.own().position_in_world - on_line);
  return heading - elementary::atan2(offset, kLookAheadOnLine * view.own().length);
}

}  // namespace

Command ram(const RammingPilot& pilot, double heading, const PilotView& view, PilotMemory& memory) {
  const geometry::Point here = view.own().position_in_world;
  const double ordered = memory.is_backing ? pilot.lever_astern : pilot.lever_ahead;
  const bool stuck = is_stuck(pilot, ordered, view, memory);
  if (!memory.is_backing && stuck) {
    turn_astern(view, memory);
  } else if (memory.is_backing && (stuck || has_backed(pilot, heading, view, memory))) {
    turn_ahead(memory);
  }
  if (memory.rams > 0)
    memory.distance_gained = std::max(memory.distance_gained, dot(here - memory.first_stuck_at, unit(heading)));
  return {memory.is_backing ? pilot.lever_astern : pilot.lever_ahead,
          steering_to_hold(heading_on_line(heading, view, memory), view)};
}

}  // namespace polynya::simulation
