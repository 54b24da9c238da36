#pragma once

#include <optional>

#include "dynamics/ship/manoeuvring.hpp"
#include "dynamics/ship/propulsion.hpp"
#include "dynamics/ship/rudder.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// Data of a ship's motion through the water: hull, engine, steering. They are computed once from the scene.
struct Sailing {
  bool is_active = false;      ///< true if the ship has water around its hull, an engine or a mooring (sails)
  dynamics::HullInWater hull;  ///< hull in the water; without any force if no water acts on it
  std::optional<dynamics::Engine> engine;
  std::optional<dynamics::Rudder> rudder;
  double stern = 0;          ///< x of rudder or thrusters in the ship's frame: the aft end of the waterline [m]
  double steering_rate = 0;  ///< rate at which rudder or thrusters turn [rad/s]
  double steering_most = 0;  ///< largest angle to either side; 0 for a ship that cannot be steered [rad]
  /// True if the ship has thrusters that turn instead of rudders.
  bool has_azimuth = false;
};

/// Returns length, beam, draught and block coefficient of a ship. The block coefficient follows from the mass if the
/// scene does not give it. `water_density` is in kg/m³.
dynamics::MainDimensions dimensions_of(const Ship& ship, double water_density);

/// Returns the data of a ship's motion. They are empty for a ship that does not sail.
Sailing sailing_of(const Ship& ship, double water_density);

}  // namespace polynya::simulation
