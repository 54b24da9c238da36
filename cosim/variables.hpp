#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "io/scene/scene_parameters.hpp"

namespace polynya::cosim {

/// Side that moves a ship. The unit's enumeration has the same numbers.
enum class Control {
  kScene = 1,    ///< the scene: its propulsion and its pilot
  kCommand = 2,  ///< the other side, by thrust lever and steering angle; for a ship with an engine
  kMotion = 3,   ///< the other side, which integrates the motion and gives pose and velocity
};

enum class VariableType { kReal, kInteger, kBoolean, kControl };
enum class Causality { kParameter, kCalculatedParameter, kInput, kOutput };

/// One variable of a unit. Its value reference is its number in the list.
struct Variable {
  std::string name;
  std::string unit;  ///< empty for none
  std::string meaning;
  VariableType type = VariableType::kReal;
  Causality causality = Causality::kOutput;
  double start = 0;  ///< of parameters and inputs
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
};

/// Places in the list of the inputs of a ship.
struct ShipInputs {
  std::size_t control = 0;  ///< a Control
  std::size_t command = 0;  ///< lever, steering angle
  std::size_t force = 0;    ///< surge, sway, yaw; acts in addition to whatever else moves the ship
  std::size_t motion = 0;   ///< x, y, heading, vx, vy, yaw rate
};

/// All variables of a scene as a unit, and where they are.
struct Interface {
  std::vector<Variable> variables;
  std::size_t tick = 0;                        ///< length of a tick, which follows from the parameters [s]
  std::size_t first_parameter = 0;             ///< of `parameters`, which follow one another
  std::vector<io::SceneParameter> parameters;  ///< in the order of their variables
  std::vector<ShipInputs> ships;               ///< a member a ship
  std::size_t first_output = 0;                ///< place of the first output of the first hull
  std::size_t first_count = 0;                 ///< floes, bends, splits
};

/// Returns the variables of a scene.
Interface interface_of(const io::LoadedScene& scene);

}  // namespace polynya::cosim
