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

/// A floe in the form in which pilots see it.
struct SeenFloe {
  FloeId floe = 0;
  geometry::Point position_in_world;  ///< position of its centre of mass [m]
  double area = 0;                    ///< area in plan [m²]
};

/// A ship, structure or wall in the form in which pilots see it.
struct SeenHull {
  geometry::Point position_in_world;  ///< position of the origin of its frame; of a ship its centre of gravity [m]
  double heading = 0;                 ///< heading, counter-clockwise from the x axis [rad]
  geometry::Vector velocity;          ///< velocity over ground [m/s]
  double length = 0;                  ///< length of its waterline [m]
  double stern = 0;                   ///< x of the aft end of its waterline in its frame [m]
  /// x of the fore end of its waterline in its frame [m].
  double stem = 0;
  bool is_wall = false;
  bool is_fixed = false;  ///< true for a structure or a wall
  double lap_share = 0;   ///< completed fraction of the lap of its pattern; negative before the first lap [-]
  /// Floe to which it sails, if it manages ice.
  FloeId target_floe = kNoFloe;
};

/// Data about its ship and the surroundings that a pilot receives in each step.
struct PilotView {
  double time = 0;  ///< time at the start of the step [s]
  double step = 0;  ///< time until the next command [s]
  int ship = 0;     ///< number of the pilot's ship in `hulls`
  std::span<const SeenHull> hulls;
  dynamics::Planar through_water;  ///< velocity through the water in the ship's frame [m/s, rad/s]
  double speed_over_ground = 0;    ///< speed ahead over ground [m/s]
  double lever = 0;                ///< present position of the thrust lever, −1 to 1 [-]
  double steering_angle = 0;       ///< present angle of rudder or thrusters, positive to port [rad]
  double steering_most = 0;        ///< largest angle to either side; 0 for a ship that cannot be steered [rad]
  double steering_gain = 0;        ///< yaw acceleration per steering angle at the present thrust and speed [1/s²]
  dynamics::Planar ice_force;      ///< force of the ice on the ship in the previous step [N, N m]
  geometry::Vector ice_drift;      ///< velocity over ground of ice that current and wind move freely [m/s]
  std::function<std::vector<SeenFloe>()> floes;  ///< returns the floating floes
  dynamics::Engine engine;
  double mass = 0;  ///< mass of the ship with the added mass ahead [kg]

  const SeenHull& own() const { return hulls[static_cast<std::size_t>(ship)]; }
};

/// Orders of a pilot to the engine and the steering. Values beyond the stops are limited to the stops.
struct Command {
  double lever = 0;
  double steering_angle = 0;  ///< angle of rudder or thrusters, positive to port [rad]
};

/// Additional memory of a pilot that manages ice.
struct PatternMemory {
  double upstream = 0;        ///< direction against the drift of the ice, from the x axis [rad]
  double lap_share = -1;      ///< completed fraction of the lap; negative before the first lap [-]
  geometry::Vector carried;   ///< displacement of the pattern by the drift since its lap began [m]
  FloeId target = kNoFloe;    ///< floe to which the ship sails
  geometry::Point target_at;  ///< position of that floe over ground [m]
  double next_choice = 0;     ///< time at which the ship chooses a floe again [s]
};

/// Memory of a pilot from step to step. It is part of checkpoints.
struct PilotMemory {
  double heading = 0;         ///< heading at the start; of a route the course of the present leg [rad]
  double speed_integral = 0;  ///< integral part of the speed control [m/s²]
  double drift_angle = 0;     ///< smoothed angle from the heading to the course over ground, positive to port [rad]
  std::int32_t waypoint = 0;  ///< number of the next waypoint
  geometry::Point from;       ///< start of the present leg [m]
  bool is_backing = false;    ///< true while a ramming ship has the order to go astern
  double slow_since = 0;      ///< time since which the ship has been stuck, with the lever at its order [s]
  geometry::Point stuck_at;   ///< position at which it was stuck last [m]
  /// Position at which it was stuck for the first time [m].
  geometry::Point first_stuck_at;
  std::int32_t rams = 0;       ///< number of charges after the first
  double distance_gained = 0;  ///< largest distance along the heading from first_stuck_at [m]
  PatternMemory pattern;
};

/// Returns the memory of a pilot at the start of a run.
PilotMemory memory_at_start(const PilotView& view);

/// Returns the command of a pilot of the scene, and updates its memory.
Command command_of(const PilotSettings& pilot, const PilotView& view, PilotMemory& memory);

/// A pilot from outside, which replaces a pilot of the scene. Its memory belongs to its caller.
using ExternalPilot = std::function<Command(const PilotView&)>;

// Functions that several pilots use.

double wrapped(double angle);         ///< angle in the range −π to π [rad]
geometry::Vector unit(double angle);  ///< unit vector at an angle from the x axis
double angle_of(geometry::Vector v);  ///< angle of a vector from the x axis [rad]

/// Returns the lever that holds a speed ahead through the water [m/s]. The thrust is the one for that speed in open
/// water, plus a proportional and an integral part of the error. The integral does not grow while the lever is at a
/// stop.
double lever_to_hold(double speed, const PilotView& view, PilotMemory& memory);

/// Returns the steering angle that holds a heading [rad]. It is proportional to the error, with a damping that depends
/// on the present effect of the steering. Returns 0 if the steering has no effect.
double steering_to_hold(double heading, const PilotView& view);

/// Returns the command of a ship that rams along a heading [rad], and counts charges and distance gained (ram.cpp).
Command ram(const RammingPilot& pilot, double heading, const PilotView& view, PilotMemory& memory);

/// Returns the command of a ship that manages ice (manage.cpp).
Command steer(const ManagingPilot& pilot, const PilotView& view, PilotMemory& memory);

}  // namespace polynya::simulation
