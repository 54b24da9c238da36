// Ships: prescribed speeds and what they take, several in one scene, drift and moving frames.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

void add_pack(Scene& scene, double x0, double y0, int columns, int rows) {
  for (int c = 0; c < columns; ++c) {
    for (int r = 0; r < rows; ++r) {
      const double x = x0 + 13.5 * c;
      const double y = y0 + 13.5 * r;
      scene.floes.push_back(floe(rectangle(x, y, x + 10, y + 10)));
    }
  }
}

TEST(ConstantSpeed, IsKeptExactlyAndTheForcesAreWhatItTakes) {
  Scene scene = without_drag();
  scene.fracture.breakable_size_factor = 1e6;
  scene.ships = {icebreaker({0, 0}, ConstantSpeed{1.25})};
  scene.ships[0].heading = 0;
  add_pack(scene, 1, -40, 3, 6);
  Simulation simulation(scene);
  Vector impulse;
  for (int i = 0; i < 200; ++i) {
    const Story story = run(simulation, simulation.time() + 0.1);
    for (const ShipSample& sample : story.samples) {
      ASSERT_EQ(sample.velocity_in_world, (Vector{1.25, 0}));
      ASSERT_EQ(sample.heading, 0);
      ASSERT_EQ(sample.yaw_rate, 0);
      ASSERT_EQ(sample.thrust, -sample.from_ice.surge);
      impulse += scene.record.forces_interval * Vector{sample.from_ice.surge, sample.from_ice.sway};
    }
  }
  // Newton's third law: what the ice did to the ship is what the ship gave the floes.
  Vector given;
  for (const FloeState& state : simulation.floe_states()) given += state.mass * state.velocity;
  EXPECT_GT(given.x, 1e4);
  EXPECT_NEAR(impulse.x / given.x, -1, 1e-9);
  EXPECT_NEAR(impulse.y, -given.y, 1e-9 * given.x);
  EXPECT_NEAR(simulation.ship_states()[0].world_from_ship.position.x, -60 + 1.25 * simulation.time(), 1e-9);
}

TEST(ConstantThrust, GivesTheShipWhatTheIceDoesNotTake) {
  Scene scene = without_drag();
  scene.fracture.breakable_size_factor = 1e6;
  scene.ships = {icebreaker({0, 0}, ConstantThrust{2e5})};
  add_pack(scene, 1, -40, 2, 6);
  Simulation simulation(scene);
  const Story story = run(simulation, 15);
  double surge = 0;
  for (const ShipSample& sample : story.samples) surge += 0.1 * sample.from_ice.surge;
  const ShipState ship = simulation.ship_states()[0];
  EXPECT_LT(surge, -1e4);
  EXPECT_NEAR(ship.heading, 0, 0.1);
  // Along the heading, which hardly turns: m Δv = T t + Σ surge.
  EXPECT_NEAR(1e7 * (ship.velocity.x - 1) / (2e5 * simulation.time() + surge), 1, 2e-2);
}

TEST(Ships, SeveralDoNotDisturbOneAnother) {
  // The same ship and ice, alone and with another ship at work 2 km away: the same numbers to the last bit.
  Scene alone;
  alone.ships = {icebreaker({0, 0}, ConstantThrust{2e4})};
  alone.floes = {floe(rectangle(0.5, -40, 40.5, 40))};
  Scene both = alone;
  both.ships.push_back(icebreaker({0, 2000}, ConstantSpeed{2}));
  both.floes.push_back(floe(rectangle(1.5, 1960, 50, 2040)));
  Simulation one(alone);
  Simulation two(both);
  const Story story_of_one = run(one, 8);
  const Story story_of_two = run(two, 8);
  std::vector<ShipSample> first;
  std::vector<ShipSample> second;
  for (const ShipSample& sample : story_of_two.samples) (sample.ship == 0 ? first : second).push_back(sample);
  ASSERT_EQ(first.size(), story_of_one.samples.size());
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    ASSERT_EQ(first[i].from_ice.surge, story_of_one.samples[i].from_ice.surge) << i;
    ASSERT_EQ(first[i].position_in_world, story_of_one.samples[i].position_in_world) << i;
    ASSERT_EQ(first[i].from_ice_largest.surge, story_of_one.samples[i].from_ice_largest.surge) << i;
  }
  const auto met_ice = [](const ShipSample& sample) { return sample.from_ice.surge < 0; };
  EXPECT_TRUE(std::any_of(first.begin(), first.end(), met_ice));
  EXPECT_TRUE(std::any_of(second.begin(), second.end(), met_ice));
  EXPECT_TRUE(std::any_of(story_of_two.events.begin(), story_of_two.events.end(),
                          [](const Event& e) { return e.ship == 1; }));
}

TEST(Ships, MeetAsEq5Says) {
  // Two equal barges bow to bow, steel on steel: no crushing, restitution in one blow.
  Scene scene = without_drag();
  scene.ships = {barge({0, 0}, ConstantThrust{0}, 0.5), barge({0, 0}, ConstantThrust{0}, 0.5)};
  scene.ships[1].position_in_world = {60.05, 0};
  scene.ships[1].heading = std::numbers::pi;
  Simulation simulation(scene);
  run(simulation, 0.2);
  EXPECT_NEAR(simulation.ship_states()[0].velocity.x, -0.05, 1e-6);
  EXPECT_NEAR(simulation.ship_states()[1].velocity.x, 0.05, 1e-6);
}

TEST(Drift, AFloeDriftsWithTheWaterAndFeelsNothing) {
  Scene scene = paper_scene();
  scene.water.drift = {-0.05, -0.05};
  scene.floes = {floe(rectangle(0, 0, 15, 15)), floe(rectangle(40, 3, 55, 18))};
  Simulation simulation(scene);
  run(simulation, 50);
  for (const FloeState& state : simulation.floe_states()) {
    EXPECT_EQ(state.velocity, (Vector{-0.05, -0.05}));
    EXPECT_EQ(state.angular_velocity, 0);
    EXPECT_NEAR(state.world_from_body.position.x, -2.5, 1e-9);
    EXPECT_NEAR(state.world_from_body.position.y, -2.5, 1e-9);
  }
}

TEST(Drift, IsTheSameSceneSeenFromAMovingFrame) {
  // Drift along the course: relative to the water the ship is faster by as much. The same forces, cracks and
  // tracks.
  const auto scene_with = [](double drift) {
    Scene scene = paper_scene();
    scene.water.drift = {drift, 0};
    scene.ships = {icebreaker({0, 0.7}, ConstantThrust{2e4}, 1 + drift)};
    add_pack(scene, 1, -40, 2, 6);
    scene.floes.push_back(floe(rectangle(30, -50, 80, 50)));
    return scene;
  };
  Simulation still(scene_with(0));
  Simulation drifting(scene_with(-0.25));
  const Story seen_still = run(still, 40);
  const Story seen_drifting = run(drifting, 40);
  ASSERT_EQ(seen_still.events.size(), seen_drifting.events.size());
  EXPECT_GT(seen_still.events.size(), 1u);
  ASSERT_EQ(seen_still.samples.size(), seen_drifting.samples.size());
  for (std::size_t i = 0; i < seen_still.samples.size(); ++i) {
    const ShipSample& p = seen_still.samples[i];
    const ShipSample& q = seen_drifting.samples[i];
    ASSERT_NEAR(p.from_ice.surge, q.from_ice.surge, 1e-6 * (1 + std::abs(p.from_ice.surge))) << p.time;
    ASSERT_NEAR(distance(p.position_in_world, q.position_in_world + Vector{0.25 * q.time, 0}), 0, 1e-9);
    ASSERT_NEAR(length(p.velocity_in_world - q.velocity_in_world - Vector{0.25, 0}), 0, 1e-12);
  }
  const std::vector<FloeState> p = still.floe_states();
  const std::vector<FloeState> q = drifting.floe_states();
  ASSERT_EQ(p.size(), q.size());
  for (std::size_t i = 0; i < p.size(); ++i) {
    EXPECT_NEAR(distance(p[i].world_from_body.position, q[i].world_from_body.position + Vector{0.25 * 40, 0}),
                0, 1e-9);
    EXPECT_NEAR(p[i].angle, q[i].angle, 1e-12);
  }
}

}  // namespace
}  // namespace polynya::simulation
