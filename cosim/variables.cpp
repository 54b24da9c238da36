#include "cosim/variables.hpp"

#include <cmath>
#include <numbers>

#include "cosim/hull_outputs.hpp"
#include <fmt/format.h>

namespace polynya::cosim {
namespace {

constexpr double kLargestInteger = 2147483647;  ///< of the standard's integers
constexpr double kMostForce = 1e12;             ///< from outside [N, N m]
constexpr double kMostSpeed = 30;               ///< of a ship [m/s]
constexpr double kMostYawRate = 10;             ///< of a ship [rad/s]
constexpr double kMostCoordinate = 1e9;         ///< [m]
constexpr double kMostHeading = 1e6;            ///< with all turns [rad]

/// The variable of a parameter of the scene. The standard has closed ranges: an excluded end becomes the number next
/// to it.
Variable variable_of(const io::SceneParameter& parameter) {
  Variable v{.name = parameter.path, .unit = parameter.unit, .meaning = parameter.meaning};
  v.causality = Causality::kParameter;
  v.start = parameter.value;
  v.least = parameter.range.low;
  v.most = parameter.range.high;
  if (parameter.range.is_low_excluded) v.least = std::nextafter(v.least, v.most);
  if (parameter.range.is_high_excluded) v.most = std::nextafter(v.most, v.least);
  if (parameter.kind == io::FieldKind::kBoolean) v.type = VariableType::kBoolean;
  if (parameter.kind != io::FieldKind::kInteger) return v;
  v.type = VariableType::kInteger;
  v.least = std::max(std::ceil(v.least), -kLargestInteger);
  v.most = std::min(std::floor(v.most), kLargestInteger);
  return v;
}

/// An input that is a real number within ± most.
Variable input(std::string name, const char* unit, const char* meaning, double most, double start = 0) {
  return {std::move(name), unit, meaning, VariableType::kReal, Causality::kInput, start, -most, most};
}

ShipInputs add_ship(const simulation::Ship& ship, std::vector<Variable>& list) {
  ShipInputs places;
  const bool has_engine = std::holds_alternative<simulation::Engine>(ship.propulsion);
  places.control = list.size();
  list.push_back({ship.name + ".control", "",
                  "who moves the ship: the scene, commands (lever and steering), or motion (pose and velocity given)",
                  VariableType::kControl, Causality::kParameter,
                  static_cast<double>(has_engine ? Control::kCommand : Control::kScene), 1, 3});
  const auto add = [&](const char* name, const char* unit, const char* meaning, double most, double start = 0) {
    list.push_back(input(fmt::format("{}.{}", ship.name, name), unit, meaning, most, start));
  };
  places.command = list.size();
  add("command.lever", "", "thrust lever to go to, -1 full astern, 1 full ahead; for control by commands", 1);
  add("command.steering_angle_rad", "rad", "angle of rudder or thrusters to go to, to port; for control by commands",
      std::numbers::pi);
  places.force = list.size();
  add("external.surge_N", "N", "force from outside, ahead; adds to what else moves the ship", kMostForce);
  add("external.sway_N", "N", "force from outside, to port", kMostForce);
  add("external.yaw_Nm", "N.m", "moment from outside, counter-clockwise", kMostForce);
  places.motion = list.size();
  const geometry::Point at = ship.position_in_world;
  add("motion.x_m", "m", "position at the start of the communication step; for control by motion", kMostCoordinate,
      at.x);
  add("motion.y_m", "m", "position at the start of the communication step; for control by motion", kMostCoordinate,
      at.y);
  add("motion.heading_rad", "rad", "heading at the start of the communication step; for control by motion",
      kMostHeading, ship.heading);
  add("motion.vx_m_per_s", "m/s", "velocity over ground in the communication step; for control by motion", kMostSpeed);
  add("motion.vy_m_per_s", "m/s", "velocity over ground in the communication step; for control by motion", kMostSpeed);
  add("motion.yaw_rate_rad_per_s", "rad/s", "yaw rate in the communication step; for control by motion", kMostYawRate);
  return places;
}

void add_outputs(const std::string& hull, bool is_ship, std::vector<Variable>& list) {
  for (const HullOutput& output : hull_outputs()) {
    if (output.is_of_ships && !is_ship) continue;
    Variable v{fmt::format("{}.{}", hull, output.name), std::string(output.unit), std::string(output.meaning)};
    if (output.is_count) v.type = VariableType::kInteger;
    list.push_back(std::move(v));
  }
}

void add_count(const char* name, const char* meaning, std::vector<Variable>& list) {
  Variable v{name, "", meaning};
  v.type = VariableType::kInteger;
  list.push_back(std::move(v));
}

}  // namespace

Interface interface_of(const io::LoadedScene& scene) {
  Interface result;
  std::vector<Variable>& list = result.variables;
  result.tick = list.size();
  Variable tick{"tick_s", "s", "length of a tick: communication steps are whole multiples of it"};
  tick.causality = Causality::kCalculatedParameter;
  tick.start = scene.scene.time.step;
  list.push_back(std::move(tick));
  result.parameters = io::scene_parameters(scene);
  result.first_parameter = list.size();
  for (const io::SceneParameter& parameter : result.parameters) list.push_back(variable_of(parameter));
  for (const simulation::Ship& ship : scene.scene.ships) result.ships.push_back(add_ship(ship, list));
  result.first_output = list.size();
  for (const simulation::Ship& ship : scene.scene.ships) add_outputs(ship.name, true, list);
  for (const simulation::Structure& structure : scene.scene.structures) add_outputs(structure.name, false, list);
  result.first_count = list.size();
  add_count("floes", "number of floating floes at the end of the communication step", list);
  add_count("bends", "number of bends so far, each of which breaks off a cusp", list);
  add_count("splits", "number of splits so far", list);
  return result;
}

}  // namespace polynya::cosim
