#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "dynamics/planar.hpp"
#include "dynamics/ship/propulsion.hpp"
#include "simulation/ship/sailing_settings.hpp"
#include "simulation/world/event.hpp"

namespace polynya::simulation {

/// A floe as pilots see it.
struct SeenFloe {
  FloeId floe = 0;
  geometry::Point position_in_world;  ///< of its centre of mass [m]
  double area = 0;                    ///< [m²]
};

/// A hull (of a ship, structure or wall) as pilots see it.
struct SeenHull {
  geometry::Point position_in_world;  ///< of its centre of gravity [m]
  double heading = 0;                 ///< [rad]
  geometry::Vector velocity;          ///< over ground [m/s]
  double length = 0;                  ///< of its waterline [m]
  double stern = 0;                   ///< x of its waterline's ends from the centre of gravity [m]
  double stem = 0;
  bool is_wall = false;
  bool is_fixed = false;  ///< a structure or a wall
  double lap_share = 0;   ///< of the pattern that it goes round, done
  FloeId target_floe = kNoFloe;
};

/// What a pilot knows of its ship in a step.
struct PilotView {
  double time = 0;  ///< [s]
  double step = 0;  ///< Δt to the next command [s]
  int ship = 0;     ///< its own, among `hulls`
  std::span<const SeenHull> hulls;
  dynamics::Planar through_water;                ///< [m/s, rad/s]
  double speed_over_ground = 0;                  ///< ahead [m/s]
  double lever = 0;                              ///< where it is
  double steering_angle = 0;                     ///< where rudder or thrusters are, to port [rad]
  double steering_most = 0;                      ///< to either side; 0: nothing to steer with [rad]
  double steering_gain = 0;                      ///< yaw acceleration by steering, now [rad/s² per rad]
  dynamics::Planar ice_force;                    ///< on the ship, of the step before [N, N m]
  geometry::Vector ice_drift;                    ///< of free ice by current and wind, over ground [m/s]
  std::function<std::vector<SeenFloe>()> floes;  ///< those that float
  dynamics::Engine engine;
  double mass = 0;  ///< with the water's inertia ahead [kg]

  const SeenHull& own() const { return hulls[static_cast<std::size_t>(ship)]; }
};

/// What the engine and the steering are to go to. What lies beyond their stops is limited to these.
struct Command {
  double lever = 0;
  double steering_angle = 0;  ///< to port [rad]
};

/// What a pilot that manages ice remembers besides.
struct PatternMemory {
  double upstream = 0;        ///< the direction against the drift [rad]
  double lap_share = -1;      ///< of the lap, done; < 0: before the first
  geometry::Vector carried;   ///< how far the drift has taken the pattern since its lap began [m]
  FloeId target = kNoFloe;    ///< the floe to which it goes
  geometry::Point target_at;  ///< over ground [m]
  double next_choice = 0;     ///< [s]
};

/// What a pilot remembers from step to step. Kept in checkpoints.
struct PilotMemory {
  double heading = 0;         ///< at the start [rad]
  double speed_integral = 0;  ///< [m/s²]
  double drift_angle = 0;     ///< of the course over ground from the heading, smoothed [rad]
  std::int32_t waypoint = 0;  ///< the next one
  geometry::Point from;       ///< where the present leg begins [m]
  bool is_backing = false;    ///< the engine is ordered astern, to ram again
  double slow_since = 0;      ///< since when the ship stands with the lever where it was ordered to [s]
  geometry::Point stuck_at;   ///< where it was last stuck [m]
  geometry::Point first_stuck_at;
  std::int32_t rams = 0;       ///< charges after the first
  double distance_gained = 0;  ///< along the heading from where it was first stuck [m]
  PatternMemory pattern;
};

/// A pilot's memory at the start.
PilotMemory memory_at_start(const PilotView& view);

/// What a pilot of the scene does.
Command command_of(const PilotSettings& pilot, const PilotView& view, PilotMemory& memory);

/// A pilot from outside: takes the place of the scene's. Its own memory is its caller's.
using ExternalPilot = std::function<Command(const PilotView&)>;

// What pilots share: how lever and steering hold a speed and a heading.

double wrapped(double angle);         ///< to −π to π [rad]
geometry::Vector unit(double angle);  ///< of length 1
double angle_of(geometry::Vector v);  ///< [rad]

/// Holds a speed: the thrust of open water at that speed, and of what closes the error, with its integral
/// while the lever is not at a stop.
double lever_to_hold(double speed, const PilotView& view, PilotMemory& memory);

/// Holds a heading: proportional to the error, damped by what the steering can do at the moment.
double steering_to_hold(double heading, const PilotView& view);

/// Rams along a heading [rad] (ram.cpp), and counts rams and metres gained.
Command ram(const RammingPilot& pilot, double heading, const PilotView& view, PilotMemory& memory);

/// Ice management (manage.cpp).
Command steer(const ManagingPilot& pilot, const PilotView& view, PilotMemory& memory);

}  // namespace polynya::simulation
