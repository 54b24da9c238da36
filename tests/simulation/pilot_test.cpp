// Who works lever and steering: each pilot in a short run.
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/world/step.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;

constexpr double kLength = 120;

Ship ship_with(const PilotSettings& pilot, double speed = 4, const Steering& steering = RudderSettings{13}) {
  Ship ship = icebreaker(
      {60, 0}, Engine{.bollard_pull = 1e6, .open_water_speed = 8, .power = 12e6, .propeller_area = 25},
      speed);
  ship.hull.draught = 6;
  ship.water.acts = true;
  ship.water.block_coefficient = 0.579;
  ship.steering = steering;
  ship.pilot = pilot;
  return ship;
}

Scene alone(const PilotSettings& pilot, double speed = 4, const Steering& steering = RudderSettings{13}) {
  Scene scene;
  scene.time.step = 0.1;
  scene.record.forces_interval = 1;
  scene.ships = {ship_with(pilot, speed, steering)};
  return scene;
}

Story sail(const Scene& scene, double until) {
  Simulation simulation(scene);
  Story story = run(simulation, until);
  EXPECT_TRUE(simulation.audit().is_closed());
  return story;
}

double turned(const ShipSample& s) {
  return s.heading / kDegree;
}

TEST(Pilot, LeverAndRudderMoveAtTheirRates) {
  TablePilot table{{{0, 0, 0}, {10, 0, 0}, {10.001, 1, 35 * kDegree}}};
  Scene scene = alone(table);
  std::get<Engine>(scene.ships[0].propulsion).lever_rate = 0.02;
  const Story story = sail(scene, 80);
  EXPECT_EQ(story.samples[8].lever, 0);
  EXPECT_NEAR(story.samples[19].lever, 0.2, 0.01);                       // 10 s later
  EXPECT_NEAR(story.samples[14].steering_angle, 15 * kDegree, kDegree);  // 5 s at 3 °/s
  EXPECT_NEAR(story.samples.back().lever, 1, 1e-12);
  EXPECT_NEAR(story.samples.back().steering_angle, 35 * kDegree, 1e-12);
  EXPECT_NEAR(story.samples.back().delivered_power, 12e6, 1);
}

TEST(Pilot, ByTheClockItIsLinearBetweenRows) {
  const Story story = sail(alone(TablePilot{{{0, -0.2, 0}, {100, 0.8, 10 * kDegree}}}), 120);
  EXPECT_NEAR(story.samples[49].lever, 0.3, 0.01);
  EXPECT_NEAR(story.samples[49].steering_angle, 5 * kDegree, 0.2 * kDegree);
  EXPECT_NEAR(story.samples.back().lever, 0.8, 1e-12);
}

TEST(Pilot, HoldsASpeedAlsoAgainstAResistance) {
  for (const double damping : {0.0, 1e5}) {
    Scene scene = alone(SpeedPilot{.speed = 3}, 0);
    scene.ships[0].mooring = MooringSettings{};
    scene.ships[0].mooring->surge_damping = damping;
    const Story story = sail(scene, 600);
    EXPECT_NEAR(story.samples.back().velocity_in_world.x, 3, 0.01);
    for (const ShipSample& s : story.samples) EXPECT_LT(s.velocity_in_world.x, 3.3);
  }
}

TEST(Pilot, StopsAShipAstern) {
  const Story story = sail(alone(SpeedPilot{.speed = 0}, 6), 300);
  EXPECT_LT(story.samples[20].lever, -0.1);
  EXPECT_NEAR(length(story.samples.back().velocity_in_world), 0, 0.05);
}

TEST(Pilot, HoldsAHeadingByRudderAndByThrusters) {
  for (const Steering& steering : {Steering{RudderSettings{13}}, Steering{AzimuthSettings{}}}) {
    const Story story = sail(alone(HeadingPilot{.heading = 40 * kDegree, .lever = 0.5}, 4, steering), 500);
    double most = 0;
    for (const ShipSample& s : story.samples) most = std::max(most, turned(s));
    EXPECT_LT(most, 45);
    EXPECT_NEAR(turned(story.samples.back()), 40, 0.5);
    EXPECT_NEAR(story.samples.back().yaw_rate, 0, 1e-4);
  }
}

RoutePilot route() {
  return {{{{800, 0}, 4}, {{1400, 600}, 3}, {{2400, 600}, 4}}};
}

double nearest(const Story& story, Point to) {
  double least = 1e9;
  for (const ShipSample& s : story.samples) least = std::min(least, distance(s.position_in_world, to));
  return least;
}

TEST(Pilot, FollowsARouteAndStops) {
  const Story story = sail(alone(route()), 1500);
  for (const Waypoint& waypoint : route().waypoints)
    EXPECT_LT(nearest(story, waypoint.position_in_world), kLength);
  for (const ShipSample& s : story.samples)
    if (s.position_in_world.x > 2000 && s.position_in_world.x < 2280) {
      EXPECT_NEAR(s.position_in_world.y, 600, 0.1 * kLength);
    }
  const ShipSample& last = story.samples.back();
  EXPECT_LT(length(last.velocity_in_world), 0.1);
  EXPECT_LT(distance(last.position_in_world, {2400, 600}), 4 * kLength);
}

TEST(Pilot, MakesGoodADriftAcrossItsRoute) {
  RoutePilot across{{{{4000, 0}, 4}}};
  Scene scene = alone(across);
  scene.water.drift = {0, 0.5};
  double last = 0;
  for (const ShipSample& s : sail(scene, 900).samples)
    if (s.position_in_world.x < 3800) last = s.position_in_world.y;
  EXPECT_NEAR(last, 0, 4);
}

TEST(Pilot, RamsThickIceAndCountsIt) {
  Scene scene = alone(RammingPilot{.stuck_time = 5, .back_distance = 60}, 3);
  scene.time.step = 0.02;
  scene.ice.thickness = 3;
  scene.fracture.breakable_size_factor = 1e3;  // it only crushes
  scene.floes = {floe(rectangle(100, -800, 1500, 800))};
  Simulation simulation(scene);
  const Story story = run(simulation, 500);
  const ShipSample& last = story.samples.back();
  EXPECT_GE(last.rams, 2);
  EXPECT_GT(last.gained, 0);
  double farthest = 0, first = 0;
  for (const ShipSample& s : story.samples) {
    farthest = std::max(farthest, s.position_in_world.x);
    if (s.rams == 0) first = std::max(first, s.position_in_world.x);
  }
  EXPECT_NEAR(last.gained, farthest - first, 0.1);
  EXPECT_TRUE(simulation.audit().is_closed());
}

TEST(Pilot, FollowsAShipAtADistance) {
  Scene scene = alone(SpeedPilot{.speed = 3}, 3);
  Ship follower = ship_with(FollowingPilot{"icebreaker", 0, 100}, 3);
  follower.name = "follower";
  follower.position_in_world = {-400, 30};
  scene.ships.push_back(follower);
  const Story story = sail(scene, 900);
  const Point leader = story.samples[story.samples.size() - 2].position_in_world;
  const Point behind = story.samples.back().position_in_world;
  EXPECT_NEAR(leader.x - behind.x - kLength, 100, 5);
  EXPECT_NEAR(behind.y, leader.y, 5);
}

TEST(Pilot, OneFromOutsideTakesThePlaceOfTheScenes) {
  Simulation simulation(alone(ConstantPilot{1, 0}));
  std::vector<double> times;
  simulation.set_pilot(0, [&](const PilotView& view) {
    times.push_back(view.time);
    return Command{2, -10};  // beyond the stops
  });
  const Story story = run(simulation, 60);
  EXPECT_EQ(times.size(), 600U);
  EXPECT_EQ(story.samples.back().lever, 1);
  EXPECT_NEAR(story.samples.back().steering_angle, -35 * kDegree, 1e-12);
  EXPECT_LT(story.samples.back().heading, -0.1);
  simulation.set_pilot(0, {});
  EXPECT_NEAR(run(simulation, 100).samples.back().steering_angle, 0, 1e-12);
}

/// 10° of rudder to either side, laid over whenever the heading has changed by 10°.
struct ZigZag {
  std::vector<double> overshoots;  ///< [°]
  double first_turn = 0;           ///< way to the first 10° [L]
};
ZigZag zig_zag() {
  Scene scene = alone(ConstantPilot{}, 6);
  scene.ships[0].propulsion = Engine{.bollard_pull = 314e3, .open_water_speed = 6, .propeller_area = 12};
  Simulation simulation(scene);
  ZigZag result;
  double side = 1, most = 0;
  simulation.set_pilot(0, [&](const PilotView& view) {
    const double heading = view.own().heading / kDegree;
    most = std::max(most, -side * heading);
    if (side * heading >= 10) {
      if (result.first_turn == 0)
        result.first_turn = distance(view.own().position_in_world, {0, 0}) / kLength;
      else
        result.overshoots.push_back(most - 10);
      side = -side;
      most = 0;
    }
    return Command{1, side * 10 * kDegree};
  });
  run(simulation, 800);
  return result;
}

TEST(Pilot, ZigZagsAsShipsDo) {
  const ZigZag result = zig_zag();
  ASSERT_GE(result.overshoots.size(), 3U);
  // [IMO2002] at L/V = 20 s: overshoots of at most 15° and 32.5°, and 10° within 2.5 L.
  EXPECT_GT(result.overshoots[0], 1);
  EXPECT_LT(result.overshoots[0], 15);
  EXPECT_LT(result.overshoots[1], 32.5);
  EXPECT_LT(result.first_turn, 2.5);
}

TEST(Pilot, GoesOnFromItsState) {
  Scene scene = alone(route());
  Simulation whole(scene);
  run(whole, 250);
  auto resumed = Simulation::resumed(scene, whole.state());
  ASSERT_TRUE(resumed.has_value()) << resumed.error();
  run(whole, 400);
  run(*resumed, 400);
  EXPECT_EQ(whole.state_hash(), resumed->state_hash());
  EXPECT_GT(whole.world().population.helms[0].memory.waypoint, 0);
}

}  // namespace
}  // namespace polynya::simulation
