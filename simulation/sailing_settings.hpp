#pragma once

#include <numbers>
#include <optional>
#include <variant>

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
/// A rudder at the stern, in the race of the propellers.
struct RudderSettings {
  double area = 0;                            ///< A_R [m²]
  double aspect_ratio = 1.5;                  ///< Λ [-]
  double rate = 3 * std::numbers::pi / 180;   ///< [rad/s]
  double most = 35 * std::numbers::pi / 180;  ///< to either side [rad]
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
  geometry::Point position_in_world;  ///< of the ship's centre of gravity where nothing pulls [m]
  double heading = 0;                 ///< there [rad]
  double surge_stiffness = 0;         ///< [N/m]
  double sway_stiffness = 0;          ///< [N/m]
  double yaw_stiffness = 0;           ///< [N m/rad]
  double surge_damping = 0;           ///< [N s/m]
  double sway_damping = 0;            ///< [N s/m]
  double yaw_damping = 0;             ///< [N m s/rad]
  double break_load = 0;              ///< horizontal force at which it breaks; 0: never [N]
  friend bool operator==(const MooringSettings&, const MooringSettings&) = default;
};

}  // namespace polynya::simulation
