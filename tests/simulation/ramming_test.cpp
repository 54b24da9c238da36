// The ramming pilot: its orders while a ship charges, stands and backs, and ships in ice that is too thick for them.
#include <algorithm>
#include <array>
#include <cmath>

#include <gtest/gtest.h>

#include "simulation/ship/pilot.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kHullLength = 120;

// ---- the orders alone

SeenHull ship_at(geometry::Point place) {
  SeenHull ship;
  ship.position_in_world = place;
  ship.length = kHullLength;
  return ship;
}

/// A pilot with a ship whose motion the test prescribes. The lever follows its orders at a rate.
struct Bridge {
  RammingPilot pilot;
  double lever_rate = 1 / 30.0;  ///< [1/s]
  std::array<SeenHull, 1> own{ship_at({})};
  PilotMemory memory;
  dynamics::Engine engine;  ///< unknown unless a test gives one
  double mass = 0;          ///< [kg]
  double time = 0;          ///< [s]
  double lever = 1;         ///< present position of the lever [-]
  double ordered = 1;

  /// Goes on for so long at a speed ahead [m/s].
  void go(double seconds, double speed) {
    constexpr double kStep = 0.1;
    for (double gone = 0; gone < seconds - 0.5 * kStep; gone += kStep) {
      PilotView view;
      view.time = time;
      view.step = kStep;
      view.hulls = own;
      view.speed_over_ground = speed;
      view.lever = lever;
      view.engine = engine;
      view.mass = mass;
      ordered = ram(pilot, 0, view, memory).lever;
      lever = dynamics::approach(lever, ordered, lever_rate, kStep);
      own[0].position_in_world.x += kStep * speed;
      time += kStep;
    }
  }
};

TEST(RammingOrders, AreAsternWhenTheShipHasStoodForStuckS) {
  Bridge bridge;
  bridge.go(60, 2);
  bridge.go(9, 0);
  EXPECT_EQ(bridge.ordered, 1);
  bridge.go(2, 0);
  EXPECT_EQ(bridge.ordered, -1);
  EXPECT_EQ(bridge.memory.rams, 0) << "the first charge is not counted";
}

/// The engine needs a minute from full ahead to full astern, and the ship stands still during this time.
TEST(RammingOrders, StayAsternWhileTheLeverIsOnItsWay) {
  Bridge bridge;
  bridge.go(11, 0);
  ASSERT_EQ(bridge.ordered, -1);
  bridge.go(65, 0);
  EXPECT_EQ(bridge.lever, -1);
  EXPECT_EQ(bridge.ordered, -1) << "the engine has been full astern for 5 s";
  bridge.go(100, -1);
  EXPECT_EQ(bridge.ordered, -1) << "not yet a length";
  bridge.go(21, -1);
  EXPECT_EQ(bridge.ordered, 1);
  EXPECT_EQ(bridge.memory.rams, 1);
}

/// A ship that still runs astern while the engine pushes ahead is not stuck.
/// The lever needs a minute from full astern to full ahead, so the order is given before the ship is a length astern.
TEST(RammingOrders, AreAheadInTimeToStopALengthAstern) {
  Bridge bridge;
  bridge.engine = {.bollard_pull = 1.2e6, .open_water_speed = 8, .lever_rate = 1 / 30.0};
  bridge.mass = 1.1e7;
  bridge.go(11 + 60, 0);
  ASSERT_EQ(bridge.ordered, -1);
  double speed = 0;
  while (bridge.ordered < 0 || speed < 0) {
    speed += 0.1 * net_thrust(bridge.engine, bridge.lever, speed) / bridge.mass;
    bridge.go(0.1, speed);
    ASSERT_LT(bridge.time, 600);
  }
  EXPECT_NEAR(bridge.own[0].position_in_world.x, -kHullLength, 3);
}

TEST(RammingOrders, StayAheadWhileTheShipStillMovesAstern) {
  Bridge bridge;
  bridge.lever_rate = 1;
  bridge.go(11, 0);
  bridge.go(61, -2);
  ASSERT_EQ(bridge.ordered, 1);
  bridge.go(40, -2);
  EXPECT_EQ(bridge.ordered, 1);
  bridge.go(100, 3);
  EXPECT_EQ(bridge.ordered, 1);
  EXPECT_NEAR(bridge.memory.distance_gained, bridge.own[0].position_in_world.x, 0.5);
  bridge.go(11, 0.05);
  EXPECT_EQ(bridge.ordered, -1) << "stuck again";
}

TEST(RammingOrders, AreAheadAgainWhereTheShipIsStuckAsternToo) {
  Bridge bridge;
  bridge.go(11, 0);
  bridge.go(60 + 11, 0);
  EXPECT_EQ(bridge.ordered, 1);
  bridge.go(60 + 7, 0);
  EXPECT_EQ(bridge.ordered, 1);
  bridge.go(4, 0);
  EXPECT_EQ(bridge.ordered, -1);
}

/// When the ship is off its line, it turns back to the line as it charges, and keeps its heading as it backs.
TEST(RammingOrders, LeadBackToTheLineOfTheRam) {
  PilotView view;
  const std::array<SeenHull, 1> own{ship_at({0, 30})};
  view.hulls = own;
  view.speed_over_ground = 3;
  view.lever = 1;
  view.steering_most = 1;
  view.steering_gain = 1e-3;
  PilotMemory memory;
  EXPECT_LT(ram({}, 0, view, memory).steering_angle, -0.1) << "to starboard";
  memory.is_backing = true;
  view.lever = -1;
  EXPECT_EQ(ram({}, 0, view, memory).steering_angle, 0);
}

// ---- ships in ice

/// A charge that ended where the ship was stuck again.
struct Ram {
  double backed = 0;  ///< distance from where the ship was stuck to the farthest point astern [m]
  double least_lever = 0;
  double gained = 0;   ///< beyond where the ship was stuck before [m]
  double seconds = 0;  ///< time from being stuck to being stuck again [s]
};

/// All finished charges after the first: from one turn of the lever astern to the next.
std::vector<Ram> rams_of(const std::vector<HullSample>& samples) {
  std::vector<Ram> rams;
  const HullSample* stuck = nullptr;
  double least_x = 0, least_lever = 0;
  bool is_lever_falling = false;
  for (std::size_t i = 1; i < samples.size(); ++i) {
    const HullSample& s = samples[i];
    const bool falls = s.lever < samples[i - 1].lever;
    if (falls && !is_lever_falling) {
      if (stuck)
        rams.push_back({stuck->position_in_world.x - least_x, least_lever,
                        s.position_in_world.x - stuck->position_in_world.x, s.time - stuck->time});
      stuck = &s;
      least_x = s.position_in_world.x;
      least_lever = s.lever;
    }
    is_lever_falling = falls;
    least_x = std::min(least_x, s.position_in_world.x);
    least_lever = std::min(least_lever, s.lever);
  }
  return rams;
}

/// The reference ship with the default pilot before fast ice of two metres and more.
Build before_ice(double thickness, double lever_rate) {
  Ship ship = scenes::in_water(icebreaker(
      {-100, 0}, Engine{.bollard_pull = 1.2e6, .open_water_speed = 8, .lever_rate = lever_rate, .propeller_area = 12},
      0));
  ship.steering = RudderSettings{.area = 0.018 * kHullLength * 6};
  ship.pilot = RammingPilot{};
  Build scene = Build().step(0.05).without_splits().thickness(thickness).ship(ship).recorded_every(0.5);
  scene.fracture.bending_scatter = 0.2;
  return scene.floe(fast(rectangle(0, -100, 900, 100)));
}

/// The ship backs a length, stops, charges and gains, again and again. A pilot that stays stuck makes no charges or
/// gains nothing. A pilot that runs away backs farther and farther. In a channel as wide as the ship, it may once be
/// stuck astern, too.
void expect_rams(double thickness, double lever_rate, double until) {
  const Trial done = run(before_ice(thickness, lever_rate).under_hulls(false), until);
  const std::vector<Ram> rams = rams_of(done.story.samples);
  ASSERT_GE(rams.size(), 5U) << lever_rate;
  double gained = 0;
  int stuck_astern = 0;
  for (const Ram& ram : rams) {
    EXPECT_EQ(ram.least_lever, -1);
    EXPECT_LE(ram.backed, 1.05 * kHullLength);
    stuck_astern += ram.backed < 0.85 * kHullLength ? 1 : 0;
    EXPECT_GE(ram.gained, -1) << "a charge comes to where the one before ended";
    gained += ram.gained;
  }
  EXPECT_LE(stuck_astern, 1);
  EXPECT_GT(gained / static_cast<double>(rams.size()), 5) << "metres a ram";
  const HullSample& last = done.story.samples.back();
  EXPECT_GE(last.rams, std::ssize(rams));
  EXPECT_GE(last.distance_gained, gained - 1);
}

TEST(Ramming, BacksALengthStopsChargesAndGains) {
  expect_rams(2, 1 / 30.0, 1800);
}

TEST(Ramming, GainsAlsoWithAQuickLever) {
  expect_rams(2, 0.5, 1200);
}

}  // namespace
}  // namespace polynya::simulation
