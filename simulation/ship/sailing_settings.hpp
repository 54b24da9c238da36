#pragma once

#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

#include "dynamics/ship/propulsion.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::simulation {

/// The water around a ship's hull. SI units, angles in radians.
struct HullWaterSettings {
  bool acts = false;                      ///< else only ice, other ships, engine and mooring act on it
  double block_coefficient = 0;           ///< C_B; 0: by mass and main dimensions [-]
  double cross_flow_drag = 0.8;           ///< C_d of the flow across the hull (recall) [-]
  double surge_added_mass = 0.05;         ///< of the ship's mass [-]
  double resistance_coefficient = 0.004;  ///< C_T of a ship without an engine (recall) [-]
  friend bool operator==(const HullWaterSettings&, const HullWaterSettings&) = default;
};

/// No rudder, and no thrusters that turn.
struct NoSteering {
  friend bool operator==(const NoSteering&, const NoSteering&) = default;
};
/// Rudders at the stern.
struct RudderSettings {
  double area = 0;                            ///< A_R, of all together [m²]
  double aspect_ratio = 1.5;                  ///< Λ of each [-]
  double rate = 3 * std::numbers::pi / 180;   ///< [rad/s]
  double most = 35 * std::numbers::pi / 180;  ///< to either side [rad]
  int count = 0;                              ///< number of rudders; 0: one behind each propeller [-]
  friend bool operator==(const RudderSettings&, const RudderSettings&) = default;
};
/// Thrusters at the stern that turn about the vertical.
struct AzimuthSettings {
  double rate = 8 * std::numbers::pi / 180;  ///< [rad/s]
  double most = std::numbers::pi;            ///< to either side [rad]
  friend bool operator==(const AzimuthSettings&, const AzimuthSettings&) = default;
};
using Steering = std::variant<NoSteering, RudderSettings, AzimuthSettings>;

/// A linear mooring about a place over ground, in the axes of its heading.
struct MooringSettings {
  geometry::Point position_in_world = {};  ///< of the ship's centre of gravity where nothing pulls [m]
  double heading = 0;                      ///< there [rad]
  double surge_stiffness = 0;              ///< [N/m]
  double sway_stiffness = 0;               ///< [N/m]
  double yaw_stiffness = 0;                ///< [N m/rad]
  double surge_damping = 0;                ///< [N s/m]
  double sway_damping = 0;                 ///< [N s/m]
  double yaw_damping = 0;                  ///< [N m s/rad]
  double break_load = 0;                   ///< horizontal force at which it breaks; 0: never [N]
  friend bool operator==(const MooringSettings&, const MooringSettings&) = default;
};

// Who works a ship's thrust lever and steering. Angles in radians, from the x axis counter-clockwise;
// steering angles to port; levers from −1 (full astern) to 1 (full ahead); speeds ahead through the water.

inline constexpr double kAsAtStart = std::numeric_limits<double>::infinity();  ///< a heading: the ship's own

/// Lever and steering where they are.
struct ConstantPilot {
  double lever = 1;
  double steering_angle = 0;
  friend bool operator==(const ConstantPilot&, const ConstantPilot&) = default;
};
/// A speed, on a heading where the ship can be steered.
struct SpeedPilot {
  double speed = 0;  ///< [m/s]
  double heading = kAsAtStart;
  friend bool operator==(const SpeedPilot&, const SpeedPilot&) = default;
};
/// A heading, at a lever.
struct HeadingPilot {
  double heading = kAsAtStart;
  double lever = 1;
  friend bool operator==(const HeadingPilot&, const HeadingPilot&) = default;
};
struct Waypoint {
  geometry::Point position_in_world;  ///< [m]
  double speed = 0;                   ///< on the leg to it [m/s]
  friend bool operator==(const Waypoint&, const Waypoint&) = default;
};
/// From where the ship is at the start from waypoint to waypoint along straight legs; stops after the last.
struct RoutePilot {
  std::vector<Waypoint> waypoints;
  double look_ahead = 2.5;  ///< of the line of sight, of the ship's length [-]
  double arrival = 1;       ///< a waypoint counts as reached this near to it, of the ship's length [-]
  friend bool operator==(const RoutePilot&, const RoutePilot&) = default;
};
struct TableRow {
  double time = 0;  ///< [s]
  double lever = 0;
  double steering_angle = 0;
  friend bool operator==(const TableRow&, const TableRow&) = default;
};
/// By the clock: linear between rows, the first and last before and after them.
struct TablePilot {
  std::vector<TableRow> rows;  ///< ascending in time
  friend bool operator==(const TablePilot&, const TablePilot&) = default;
};
/// On a heading ahead until the ship is stuck, back, and ahead again.
struct RammingPilot {
  double heading = kAsAtStart;
  double lever_ahead = 1;
  double lever_astern = -1;
  double stuck_speed = 0.1;  ///< ahead over ground; slower is stuck [m/s]
  double stuck_time = 10;    ///< for so long [s]
  double back_distance = 0;  ///< 0: the ship's length [m]
  friend bool operator==(const RammingPilot&, const RammingPilot&) = default;
};
/// Behind another ship, at a distance from its stern to the stem.
struct FollowingPilot {
  std::string ship;     ///< its name
  int leader = 0;       ///< its index in the scene
  double distance = 0;  ///< [m]
  friend bool operator==(const FollowingPilot&, const FollowingPilot&) = default;
};
enum class ManagementPattern {
  kLinear,       ///< to and fro across the drift
  kSector,       ///< to and fro along an arc about the body
  kCircular,     ///< round an ellipse
  kRacetrack,    ///< two legs across the drift, and half circles
  kLargestFloe,  ///< to the largest floe that will pass near the body, and on to the next
};
/// Another ship of the same pattern.
struct PatternPartner {
  int ship = 0;      ///< its index in the scene
  double phase = 0;  ///< in laps
  friend bool operator==(const PatternPartner&, const PatternPartner&) = default;
};
/// Breaks the ice that drifts onto a body (docs/management.md).
struct ManagingPilot {
  std::string body;    ///< the protected one's name
  int body_index = 0;  ///< among the scene's hulls
  ManagementPattern pattern = ManagementPattern::kLinear;
  double distance = 0;           ///< of the pattern's middle, upstream of the body [m]
  double width = 0;              ///< of the pattern, across the drift [m]
  double depth = 0;              ///< along it [m]
  bool drifts_with_ice = false;  ///< the pattern, from the start of each lap; else it stays with the body
  double speed = 0;              ///< along the pattern, in its frame; 0: by the lever [m/s]
  double lever = 1;
  double phase = 0;          ///< where on the pattern it begins, of a lap [-]
  double safety_radius = 0;  ///< to the body and other ships, between centres; 0: the sum of both lengths [m]
  double least_floe = 0;     ///< smaller ones are left to themselves [m²]
  std::vector<PatternPartner> partners;
  friend bool operator==(const ManagingPilot&, const ManagingPilot&) = default;
};
using PilotSettings = std::variant<ConstantPilot, SpeedPilot, HeadingPilot, RoutePilot, TablePilot, RammingPilot,
                                   FollowingPilot, ManagingPilot>;

}  // namespace polynya::simulation
