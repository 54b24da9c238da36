#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "cosim/hull_outputs.hpp"
#include "cosim/variables.hpp"

#include "io/scene/scene_reader.hpp"
#include "simulation/simulation.hpp"

namespace polynya::cosim {

/// Inputs of a ship for a communication step. The ship's Control decides which members act.
struct ShipInput {
  double lever = 0;           ///< thrust lever to go to [-]
  double steering_angle = 0;  ///< angle of rudder or thrusters to go to, to port [rad]
  dynamics::Planar force;     ///< force and moment from outside, in the ship's frame [N, N m]
  geometry::Point position;   ///< position at the start of the communication step, world frame [m]
  double heading = 0;         ///< heading then [rad]
  geometry::Vector velocity;  ///< velocity over ground in the communication step [m/s]
  double yaw_rate = 0;        ///< yaw rate in the communication step [rad/s]
};

/// A run that another simulator steps by whole communication steps, each of which happens entirely or not at all.
class CoupledRun {
 public:
  /// Starts a run. `controls` has a member a ship. The error states which control a ship cannot have.
  static io::Result<CoupledRun> start(io::LoadedScene scene, std::vector<Control> controls);

  double tick() const { return scene_->scene.time.step; }  ///< [s]
  double time() const { return simulation_->time(); }      ///< since the start of the run [s]

  /// Advances by a number of ticks > 0 with these inputs, a member a ship. If that fails, the run is as before the
  /// call, and the error is the reason.
  io::Result<> advance(std::int64_t ticks, const std::vector<ShipInput>& inputs);

  /// The outputs of the ships, then of the structures. Loads are 0 before the first step.
  const std::vector<HullOutputs>& hulls() const { return hulls_; }
  simulation::Counts counts() const { return simulation_->counts(); }
  /// The events of the last advance(), a line of JSON each, as in events.ndjson.
  const std::string& events() const { return events_; }

  /// A checkpoint of the run. It does not hold the outputs of the step that led there.
  std::string save() const;
  /// Continues from a checkpoint of a run of the same scene, bit for bit. If that fails, the run is as before.
  io::Result<> restore(std::string_view checkpoint);

 private:
  CoupledRun(io::LoadedScene scene, std::vector<Control> controls);
  void attach_pilots();
  io::Result<> give(const std::vector<ShipInput>& inputs, double seconds);
  io::Result<> give_motion(int ship, const ShipInput& input, double seconds);
  io::Result<> step(std::int64_t ticks);
  void follow_contacts();
  void take_outputs();
  void take_motion();

  std::unique_ptr<io::LoadedScene> scene_;
  std::vector<Control> controls_;
  std::unique_ptr<std::vector<ShipInput>> inputs_;  ///< where pilots read their commands
  std::unique_ptr<simulation::Simulation> simulation_;
  std::vector<HullOutputs> hulls_;
  std::string events_;
};

}  // namespace polynya::cosim
