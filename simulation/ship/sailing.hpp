#pragma once

#include <optional>

#include "dynamics/ship/manoeuvring.hpp"
#include "dynamics/ship/propulsion.hpp"
#include "dynamics/ship/rudder.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::simulation {

/// What moves a ship beside ice and other ships: computed once, from its scene.
struct Sailing {
  bool is_active = false;      ///< any of the following
  dynamics::HullInWater hull;  ///< without any force where no water acts on it
  std::optional<dynamics::Engine> engine;
  std::optional<dynamics::Rudder> rudder;
  double stern = 0;          ///< x of rudder or thrusters from the centre of gravity [m]
  double steering_rate = 0;  ///< [rad/s]
  double steering_most = 0;  ///< to either side; 0: nothing to steer with [rad]
  bool has_azimuth = false;
};

/// L, B, T and C_B of a ship; C_B from its mass where it is not given.
dynamics::MainDimensions dimensions_of(const Ship& ship, double water_density);

Sailing sailing_of(const Ship& ship, double water_density);

}  // namespace polynya::simulation
