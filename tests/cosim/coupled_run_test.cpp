// Effects of a coupled run on a simulation: external forces, prescribed motion, ice cover ahead, and steps that fail.
#include "cosim/coupled_run.hpp"

#include <cmath>
#include <stdexcept>

#include <gtest/gtest.h>

#include "io/scene/scene_file.hpp"
#include "simulation/ship/cover_image.hpp"
#include "simulation/world/world.hpp"

namespace polynya::cosim {
namespace {

constexpr int kIcebreaker = 0, kBarge = 1;  ///< indices of the ships in coupled.json

io::LoadedScene scene_with(const std::string& assignment = "seed=3") {
  io::SceneOverrides overrides;
  overrides.assignments.push_back(*io::parse_assignment(assignment));
  return *io::read_scene_file(POLYNYA_SOURCE_DIR "/tests/cosim/coupled.json", overrides);
}

void advance(simulation::Simulation& simulation, int ticks) {
  for (int i = 0; i < ticks; ++i) simulation.step();
}

TEST(ExternalForce, AlongTheHeadingIsAThrust) {
  simulation::Simulation pushed(scene_with().scene);
  simulation::Simulation own(scene_with("ships[1].propulsion.thrust_N=20000").scene);
  pushed.set_external_force(kBarge, {20000, 0, 0});
  advance(pushed, 500);
  advance(own, 500);
  EXPECT_GT(own.ship_states()[kBarge].velocity.x, 0.1);
  EXPECT_EQ(pushed.state_hash(), own.state_hash());
  EXPECT_TRUE(pushed.audit().is_closed());
}

TEST(ExternalForce, HasAMomentAndASidewaysPartAndEndsWhenItIsSetToNothing) {
  simulation::Simulation run(scene_with().scene);
  run.set_external_force(kBarge, {0, 0, 8e5});
  advance(run, 100);  // 2 s of 8e5 N m on 8e7 kg m²
  EXPECT_NEAR(run.ship_states()[kBarge].angular_velocity, 0.02, 1e-9);
  run.set_external_force(kBarge, {});
  advance(run, 50);
  EXPECT_NEAR(run.ship_states()[kBarge].angular_velocity, 0.02, 1e-9);
  run.set_external_force(kBarge, {0, 1e5, 0});
  const double heading = run.ship_states()[kBarge].heading;
  run.step();  // 0.02 s of 1e5 N on 1e6 kg
  EXPECT_NEAR(run.ship_states()[kBarge].velocity.x, -0.002 * std::sin(heading), 1e-9);
  EXPECT_NEAR(run.ship_states()[kBarge].velocity.y, 0.002 * std::cos(heading), 1e-9);
  EXPECT_TRUE(run.audit().is_closed());
}

TEST(PrescribedMotion, IsOnlyForShipsThatHaveOne) {
  simulation::Simulation free(scene_with().scene);
  EXPECT_THROW(free.set_prescribed_motion(kBarge, {1, 0}, 0), std::invalid_argument);
  io::LoadedScene scene = scene_with();
  scene.scene.ships[kBarge].propulsion = simulation::ConstantSpeed{};
  simulation::Simulation run(scene.scene);
  run.set_prescribed_motion(kBarge, {0.5, -0.25}, 0.01);
  const geometry::Point before = run.ship_states()[kBarge].world_from_ship.position;
  advance(run, 100);
  const simulation::HullState after = run.ship_states()[kBarge];
  EXPECT_NEAR(after.world_from_ship.position.x, before.x + 1, 1e-9);
  EXPECT_NEAR(after.world_from_ship.position.y, before.y - 0.5, 1e-9);
  EXPECT_NEAR(after.heading, 0.02, 1e-12);
}

TEST(CoverAhead, IsTheShareOfALengthAhead) {
  simulation::Simulation run(scene_with().scene);
  EXPECT_NEAR(cover_ahead(run.world(), kIcebreaker), 50 / 60.0, 0.01);  // the plate begins 10 m before the stem
  EXPECT_EQ(cover_ahead(run.world(), kBarge), 0);
}

TEST(CoupledRun, RefusesCommandsToAShipWithoutAnEngine) {
  EXPECT_FALSE(CoupledRun::start(scene_with(), {Control::kCommand, Control::kCommand}));
  EXPECT_TRUE(CoupledRun::start(scene_with(), {Control::kCommand, Control::kMotion}));
}

TEST(CoupledRun, IsAsBeforeAfterAStepThatFails) {
  auto run = CoupledRun::start(scene_with(), {Control::kCommand, Control::kScene});
  ASSERT_TRUE(run);
  std::vector<ShipInput> inputs(2);
  inputs[kIcebreaker].lever = 1;
  ASSERT_TRUE(run->advance(200, inputs));
  const simulation::HullSample before = run->hulls()[kIcebreaker].sample;
  const std::string saved = run->save();
  std::vector<ShipInput> wrong = inputs;
  wrong[kIcebreaker].force = {1e12, 0, 0};
  const auto failed = run->advance(100, wrong);
  ASSERT_FALSE(failed);
  EXPECT_NE(failed.error().find("numerical failure"), std::string::npos);
  EXPECT_EQ(run->time(), 4);
  EXPECT_EQ(run->hulls()[kIcebreaker].sample, before);
  ASSERT_TRUE(run->advance(10, inputs));
  const double after = run->hulls()[kIcebreaker].sample.position_in_world.x;
  ASSERT_TRUE(run->restore(saved));
  ASSERT_TRUE(run->advance(10, inputs));
  EXPECT_EQ(run->hulls()[kIcebreaker].sample.position_in_world.x, after);
}

}  // namespace
}  // namespace polynya::cosim
