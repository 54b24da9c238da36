#pragma once

#include "simulation/ship/pilot.hpp"

namespace polynya::simulation {

// What pilots share: how lever and steering hold a speed and a heading.

double wrapped(double angle);         ///< to −π to π [rad]
geometry::Vector unit(double angle);  ///< of length 1
double angle_of(geometry::Vector v);  ///< [rad]

/// Holds a speed: the thrust of open water at that speed, and of what closes the error, with its integral
/// while the lever is not at a stop.
double lever_to_hold(double speed, const PilotView& view, PilotMemory& memory);

/// Holds a heading: proportional to the error, damped by what the steering can do at the moment.
double steering_to_hold(double heading, const PilotView& view);

/// Ice management (manage.cpp).
Command steer(const ManagingPilot& pilot, const PilotView& view, PilotMemory& memory);

}  // namespace polynya::simulation
