// How a ship rams ice that stops it: ahead until it is stuck, astern for a length, and ahead again on the same line.
#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"

#include "simulation/ship/pilot.hpp"

namespace polynya::simulation {
namespace {

/// Returns true if the ship has not moved for so long that another order is needed. A ship that still slows down
/// from the order before moves, and is not stuck; nor is one whose lever is still on its way to the order.
bool is_stuck(const RammingPilot& pilot, double ordered, const PilotView& view, PilotMemory& memory) {
  constexpr double kAtOrder = 1e-6;  // of the lever: what rounding leaves of an order
  const bool stands = std::abs(view.speed_over_ground) <= pilot.stuck_speed;
  if (!stands || std::abs(view.lever - ordered) > kAtOrder) memory.slow_since = view.time;
  return view.time - memory.slow_since >= pilot.stuck_time;
}

void turn_astern(const PilotView& view, PilotMemory& memory) {
  memory.is_backing = true;
  memory.stuck_at = view.own().position_in_world;
  if (memory.rams == 0) memory.first_stuck_at = memory.stuck_at;
}

void turn_ahead(PilotMemory& memory) {
  memory.is_backing = false;
  ++memory.rams;
}

/// Returns the heading that leads back to the line on which the ship was last stuck, so that it charges in the channel
/// that it has broken. Astern it is the line's own.
double heading_on_line(double heading, const PilotView& view, const PilotMemory& memory) {
  constexpr double kLookAheadOnLine = 1.5;  // along the line, of the ship's length; less: it turns sharply to the line
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
  const double length_to_back = pilot.back_distance > 0 ? pilot.back_distance : view.own().length;
  if (!memory.is_backing && stuck) {
    turn_astern(view, memory);
  } else if (memory.is_backing && (stuck || dot(memory.stuck_at - here, unit(heading)) >= length_to_back)) {
    turn_ahead(memory);
  }
  if (memory.rams > 0)
    memory.distance_gained = std::max(memory.distance_gained, dot(here - memory.first_stuck_at, unit(heading)));
  return {memory.is_backing ? pilot.lever_astern : pilot.lever_ahead,
          steering_to_hold(heading_on_line(heading, view, memory), view)};
}

}  // namespace polynya::simulation
