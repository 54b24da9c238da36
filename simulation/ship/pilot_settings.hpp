#pragma once

#include <limits>
#include <string>
#include <variant>
#include <vector>

#include "geometry/shape/point.hpp"

namespace polynya::simulation {

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
