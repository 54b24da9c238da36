#pragma once

#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/ship/propulsion.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// Settings of the water around a ship's hull. Units are SI and angles are in radians.
struct HullWaterSettings {
  bool acts = false;  ///< true if water acts on the hull; if false, only ice, other hulls, engine and mooring do
  double block_coefficient = 0;           ///< block coefficient C_B; 0: computed from mass and main dimensions [-]
  double cross_flow_drag = 0.8;           ///< drag coefficient C_d of the flow across the hull (recall) [-]
  double surge_added_mass = 0.05;         ///< added mass ahead / mass of the ship [-]
  double resistance_coefficient = 0.004;  ///< total resistance coefficient C_T of a ship without an engine (recall) [-]
  friend bool operator==(const HullWaterSettings&, const HullWaterSettings&) = default;
};

/// A ship without rudder and without thrusters that turn.
struct NoSteering {
  friend bool operator==(const NoSteering&, const NoSteering&) = default;
};
/// Rudders at the stern.
struct RudderSettings {
  double area = 0;                            ///< total area A_R of all rudders [m²]
  double aspect_ratio = 1.5;                  ///< aspect ratio Λ of each rudder [-]
  double rate = 3 * std::numbers::pi / 180;   ///< rate at which rudders turn [rad/s]
  double most = 35 * std::numbers::pi / 180;  ///< largest angle to either side [rad]
  int count = 0;                              ///< number of rudders; 0: one behind each propeller [-]
  friend bool operator==(const RudderSettings&, const RudderSettings&) = default;
};
/// Thrusters at the stern that turn about the vertical.
struct AzimuthSettings {
  double rate = 8 * std::numbers::pi / 180;  ///< rate at which thrusters turn [rad/s]
  double most = std::numbers::pi;            ///< largest angle to either side [rad]
  friend bool operator==(const AzimuthSettings&, const AzimuthSettings&) = default;
};
using Steering = std::variant<NoSteering, RudderSettings, AzimuthSettings>;

/// A linear mooring about a place over ground. Stiffness and damping are along the axes of the moored heading.
struct MooringSettings {
  /// Position of the ship's centre of gravity at which the mooring does not pull [m].
  geometry::Point position_in_world = {};
  double heading = 0;          ///< moored heading [rad]
  double surge_stiffness = 0;  ///< force per displacement along the moored heading [N/m]
  double sway_stiffness = 0;   ///< force per displacement across the moored heading [N/m]
  double yaw_stiffness = 0;    ///< moment per angle [N m/rad]
  double surge_damping = 0;    ///< force per speed along the moored heading [N s/m]
  double sway_damping = 0;     ///< force per speed across the moored heading [N s/m]
  double yaw_damping = 0;      ///< moment per yaw rate [N m s/rad]
  double break_load = 0;       ///< horizontal force above which the mooring breaks; 0: never [N]
  friend bool operator==(const MooringSettings&, const MooringSettings&) = default;
};

// Pilots: rules that set a ship's thrust lever and steering. Angles are in radians, counter-clockwise from the x axis;
// steering angles are positive to port; levers run from −1 (full astern) to 1 (full ahead); speeds are ahead through
// the water.

/// Value of a heading that means the ship's heading at the start.
inline constexpr double kAsAtStart = std::numeric_limits<double>::infinity();

/// Keeps lever and steering at constant positions.
struct ConstantPilot {
  double lever = 1;
  double steering_angle = 0;
  friend bool operator==(const ConstantPilot&, const ConstantPilot&) = default;
};
/// Holds a speed, and a heading if the ship can be steered.
struct SpeedPilot {
  double speed = 0;  ///< speed through the water [m/s]
  double heading = kAsAtStart;
  friend bool operator==(const SpeedPilot&, const SpeedPilot&) = default;
};
/// Holds a heading at a constant lever.
struct HeadingPilot {
  double heading = kAsAtStart;
  double lever = 1;
  friend bool operator==(const HeadingPilot&, const HeadingPilot&) = default;
};
/// A point of a route.
struct Waypoint {
  geometry::Point position_in_world;  ///< position [m]
  double speed = 0;                   ///< speed through the water on the leg to it [m/s]
  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};
/// Follows a route from the ship's position at the start, along straight legs from waypoint to waypoint. The ship stops
/// after the last one.
struct RoutePilot {
  std::vector<Waypoint> waypoints;
  double look_ahead = 2.5;  ///< distance ahead on the leg to which the ship steers, in ship lengths [-]
  double arrival = 1;       ///< distance at which a waypoint counts as reached, in ship lengths [-]
  friend bool operator==(const RoutePilot&, const RoutePilot&) = default;
};
/// Lever and steering at a time.
struct TableRow {
  double time = 0;  ///< time since the start of the run [s]
  double lever = 0;
  double steering_angle = 0;
  friend bool operator==(const TableRow&, const TableRow&) = default;
};
/// Sets lever and steering from a table: linear between rows, constant before the first and after the last row.
struct TablePilot {
  std::vector<TableRow> rows;  ///< rows, ascending in time
  friend bool operator==(const TablePilot&, const TablePilot&) = default;
};
/// Rams: goes ahead on a heading until the ship is stuck, then astern, and ahead again.
struct RammingPilot {
  double heading = kAsAtStart;
  double lever_ahead = 1;
  double lever_astern = -1;
  double stuck_speed = 0.1;  ///< speed over ground at or below which the ship counts as stuck [m/s]
  double stuck_time = 10;    ///< time for which the ship must be that slow [s]
  double back_distance = 0;  ///< distance that it goes astern; 0: the ship's length [m]
  friend bool operator==(const RammingPilot&, const RammingPilot&) = default;
};
/// Follows another ship, at a distance from its stern to the own stem.
struct FollowingPilot {
  std::string ship;     ///< name of the other ship
  int leader = 0;       ///< number of the other ship in the scene
  double distance = 0;  ///< distance from its stern to the own stem [m]
  friend bool operator==(const FollowingPilot&, const FollowingPilot&) = default;
};
/// Line or rule by which a ship manages ice.
enum class ManagementPattern {
  kLinear,       ///< to and fro across the drift
  kSector,       ///< to and fro along an arc about the body
  kCircular,     ///< round an ellipse
  kRacetrack,    ///< two legs across the drift, and half circles
  kLargestFloe,  ///< to the largest floe in the box of the pattern, then to the next one
};
/// Another ship that follows the same pattern.
struct PatternPartner {
  int ship = 0;      ///< number of the ship in the scene
  double phase = 0;  ///< its phase, as a fraction of a lap [-]
  friend bool operator==(const PatternPartner&, const PatternPartner&) = default;
};
/// Manages ice: breaks the ice that drifts towards a body (docs/management.md).
struct ManagingPilot {
  std::string body;    ///< name of the protected body
  int body_index = 0;  ///< number of the protected body among the scene's hulls
  ManagementPattern pattern = ManagementPattern::kLinear;
  double distance = 0;  ///< distance of the pattern's middle upstream of the body [m]
  double width = 0;     ///< width of the pattern across the drift [m]
  double depth = 0;     ///< depth of the pattern along the drift [m]
  /// True if the pattern drifts with the ice from the start of each lap; false if it stays with the body.
  bool drifts_with_ice = false;
  double speed = 0;  ///< speed along the pattern in its frame; 0: the lever sets the speed [m/s]
  double lever = 1;
  double phase = 0;  ///< place on the pattern at which the ship begins, as a fraction of a lap [-]
  /// Smallest distance between centres to the body and other ships; 0: the sum of both lengths [m].
  double safety_radius = 0;
  double least_floe = 0;  ///< area below which floes are left alone [m²]
  std::vector<PatternPartner> partners;
  friend bool operator==(const ManagingPilot&, const ManagingPilot&) = default;
};
using PilotSettings = std::variant<ConstantPilot, SpeedPilot, HeadingPilot, RoutePilot, TablePilot, RammingPilot,
                                   FollowingPilot, ManagingPilot>;

}  // namespace polynya::simulation
