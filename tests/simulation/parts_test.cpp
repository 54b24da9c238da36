// Parts of a tick where a hull moves fast through ice (simulation/world/parts.hpp), and the tick that is chosen.
#include "simulation/world/parts.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/state/state.hpp"
#include "simulation/world/default_tick.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// A ship of 40 m by 8 m in 20 m of fast ice of the given thickness.
Build in_level_ice(double thickness, double speed, double step) {
  Ship ship = icebreaker({0, 0}, ConstantSpeed{speed}, speed);
  ship.hull.waterline = wedge_bow_waterline(40, 8, 25 * kDegree);
  ship.hull.draught = 3;
  ship.position_in_world = {-20.5, 0};
  return Build()
      .step(step)
      .thickness(thickness)
      .without_splits()
      .cusps(CuspFate::kUnderHull)
      .recorded_each_step()
      .ship(ship)
      .floe(fast(rectangle(0, -12, 30, 12)));
}

/// Returns the mean load over 10 m of ice, once the bow is in it [N].
double mean_surge(const Scene& scene, Shortcuts shortcuts = {}) {
  const double speed = scene.ships.front().speed;
  const Trial trial = run(scene, 20.5 / speed, shortcuts);
  EXPECT_TRUE(trial.simulation.audit().is_closed());
  return -mean(trial.story, &HullSample::from_ice, 0, 10.5 / speed);
}

Scene with_step(const Build& scene, double step) {
  return Build(scene).step(step).recorded_each_step();
}

TEST(Parts, NoLoadFallsWhereAHullGoesFasterThanATickBreaksIce) {
  const Build scene = in_level_ice(0.1, 8, 0.005);
  const double fine = mean_surge(with_step(scene, 0.005 / 64));
  EXPECT_NEAR(mean_surge(scene), fine, 0.05 * fine);
  EXPECT_LT(mean_surge(scene, {.takes_parts = false}), 0.9 * fine);  // the hull passes through
}

/// Mirror images, the ice at both sides of a bow breaks at the same instant.
TEST(Parts, APlateBendsOnBothSidesOfABowInOneStep) {
  const Trial trial = run(in_level_ice(0.5, 1, 0.005), 10);
  ASSERT_GT(trial.simulation.counts().bends, 4);
  const double surge = mean(trial.story, &HullSample::from_ice);
  double sway = 0;
  for (const HullSample& sample : trial.story.samples) sway = std::max(sway, std::abs(sample.from_ice.sway));
  EXPECT_LT(sway, 1e-3 * std::abs(surge));
}

TEST(Parts, ATickHasPartsWhereIceIsThinAndOnlyThere) {
  const auto most_parts = [](double thickness) {
    Simulation simulation(in_level_ice(thickness, 8, 0.005));
    while (simulation.time() < 1) skip(simulation);
    return simulation.counts().most_parts;
  };
  EXPECT_GE(most_parts(0.1), 4);
  EXPECT_EQ(most_parts(0.5), 1);
}

TEST(Parts, ARunStopsWithinItsTicksAndGoesOnToTheSameState) {
  expect_resumes(in_level_ice(0.1, 4, 0.005), 217 * 0.005, 400 * 0.005, 3);
}

/// The expected values are computed by hand from docs/theory/steps.md.
TEST(Parts, ATickIsChosenBySpeedThicknessAndWhatIsRecorded) {
  const auto tick = [](double thickness, double speed, auto change) {
    Scene scene = in_level_ice(thickness, speed, 0.005).recorded_every(0.1);
    change(scene);
    return default_tick(scene);
  };
  const auto as_it_is = [](Scene&) {};
  const dynamics::Engine fast_engine{.bollard_pull = 1e6, .open_water_speed = 20};
  const FloeSpec sliding = floe(rectangle(200, 0, 210, 10), {3, 0}), spinning = floe(sliding.polygon_in_world, {}, 1);
  EXPECT_EQ(tick(0.5, 2, as_it_is), 0.1);     // 8 × 0.075 m / 2 m/s = 0.3 s
  EXPECT_EQ(tick(0.1, 8, as_it_is), 0.01);    // 8 × 0.015 / 8 = 0.015
  EXPECT_EQ(tick(2, 8, as_it_is), 0.01);      // 8 × 0.0375/2 / 8 = 0.019
  EXPECT_EQ(tick(0.01, 8, as_it_is), 0.001);  // 8 × 0.0015 / 8 = 0.0015
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.contact.law = ContactLaw::kImpulse; }), 0.025);  // 0.075 / 2 = 0.0375
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.record.frames_interval = 0.03; }), 0.01);
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.time.until = 1e-3; }), 0.1);                     // it is the same run
  EXPECT_EQ(tick(0.1, 2, [](Scene& s) { s.water.drift.x = -6; }), 0.0025);                 // fast ice: 0.015 / 6
  EXPECT_EQ(tick(0.5, 2, [&](Scene& s) { s.ships[0].propulsion = fast_engine; }), 0.025);  // 8 × 0.075 / 20 = 0.03
  EXPECT_EQ(tick(0.5, 2, [&](Scene& s) { s.floes.push_back(sliding); }), 0.025);           // 0.075 / 3
  EXPECT_EQ(tick(0.5, 2, [&](Scene& s) { s.floes.push_back(spinning); }), 0.01);           // 0.25 / (1 × 14.1) = 0.018
}

TEST(Parts, ATickThatAnIntervalShortensIsKnownWithoutIt) {
  Scene scene = in_level_ice(0.5, 2, 0.005).recorded_every(0.286);
  EXPECT_EQ(default_tick(scene), 0.002);
  EXPECT_EQ(tick_for_any_interval(scene), 0.1);
}

TEST(Parts, AFewThinFloesDoNotChooseTheTick) {
  Build scene = in_level_ice(0.5, 8, 0.005).recorded_every(0.1);
  const double tick = default_tick(scene);
  scene.floe(rectangle(100, 0, 105, 5)).of({.thickness = 0.05});  // 25 m² of 745
  EXPECT_EQ(default_tick(scene), tick);
  scene.floes.back().polygon_in_world = rectangle(100, 0, 105, 100);
  EXPECT_LT(default_tick(scene), tick);
}

/// In ice of 3 m a hull may move less in a part than in ice of 0.5 m (kDisplacementTimesThickness): 12.5 mm instead of
/// 75 mm.
TEST(Parts, MuchThickIceChoosesTheTickAsThinIceDoes) {
  Build scene = in_level_ice(0.5, 8, 0.005).recorded_every(0.1);
  const double tick = default_tick(scene);
  scene.floe(rectangle(100, 0, 105, 5)).of({.thickness = 3});
  EXPECT_EQ(default_tick(scene), tick);
  scene.floes.back().polygon_in_world = rectangle(100, 0, 105, 100);
  EXPECT_LT(default_tick(scene), 0.3 * tick);
}

/// Drifting floes meet fast ice at the speed of the drift, 2 m/s, and may move 75 mm towards it in a tick.
TEST(Parts, FastIceInADriftChoosesTheTickAsMovingFloesDo) {
  Build scene = in_level_ice(0.5, 0.5, 0.005).recorded_every(0.1);
  scene.water.drift = {2, 0};
  EXPECT_EQ(default_tick(scene), 0.025);
  scene.floes.back().is_fast = false;
  EXPECT_EQ(default_tick(scene), 0.1);
}

TEST(Parts, AreNoneByRigidImpulses) {
  Scene scene = in_level_ice(0.1, 4, 0.005);
  scene.contact.law = ContactLaw::kImpulse;
  Simulation simulation(scene);
  skip(simulation, 200);
  EXPECT_EQ(simulation.counts().steps_taken, 200);
}

/// Returns a ship that enters loose floes, and floes far from it that drift together and touch.
Build voyage_and_drift() {
  return Build()
      .step(0.05)
      .ship(icebreaker({0, 0}, ConstantSpeed{6}, 6))
      .grid({2, -63}, 4, 6, 20, 21)
      .floe(rectangle(0, 100, 8, 108), {0.1, 0})
      .floe(rectangle(9, 101, 17, 109), {-0.05, 0.02}, 0.002)
      .floe(rectangle(8, 110, 20, 118), {0, -0.1});
}

TEST(Parts, AreTheSameOnThreadsAndAfterAKill) {
  const Scene scene = voyage_and_drift();
  Simulation through(scene);
  skip(through, 400);
  EXPECT_GT(through.counts().most_parts, 1);
  EXPECT_GT(through.counts().steps_taken, through.counts().steps);
  EXPECT_GT(through.counts().bends + through.counts().splits, 0);
  for (const int threads : {2, 3, 8}) {
    Simulation threaded(scene);
    threaded.set_threads(threads);
    skip(threaded, 400);
    EXPECT_EQ(threaded.state_hash(), through.state_hash()) << threads;
  }
  Simulation first(scene);
  for (const int ticks : {7, 60, 1, 90, 133}) {  // taken up again after each of these
    skip(first, ticks);
    first = resumed(scene, first);
  }
  skip(first, 400 - 291);
  EXPECT_EQ(first.state_hash(), through.state_hash());
  EXPECT_EQ(first.counts().steps_taken, through.counts().steps_taken);
  expect_closed(through);
}

/// A hull that is about to reach ice takes parts before it arrives, so that it penetrates no deeper in its first step
/// than in any other step.
TEST(Parts, BeginBeforeAHullReachesTheIce) {
  Simulation simulation(in_level_ice(0.5, 8, 0.05));  // 0.4 m in a tick, of which ice of 0.5 m allows 0.075 m
  double deepest = 0;
  while (simulation.counts().crush_contacts == 0) {
    skip(simulation, 1);
    for (const dynamics::Contact& c : simulation.world().data.contacts) deepest = std::max(deepest, c.depth);
  }
  EXPECT_GE(simulation.counts().most_parts, 5);
  EXPECT_GT(deepest, 0);
}

TEST(Parts, KeepTheStepsOfWallsThatPressShort) {
  Scene scene = Build().step(0.1).floe(rectangle(0, 0, 10, 10));
  Wall wall;
  wall.position_in_world = {-1, 5};
  wall.length = 30;
  wall.hull.waterline = rectangle(-1, -15, 0, 15).outer;
  wall.pressure = WallPressure{.line_load = 1e3};
  scene.walls.push_back(wall);
  Simulation simulation(scene);
  skip(simulation, 10);
  EXPECT_EQ(simulation.counts().steps_taken, 40);
}

}  // namespace
}  // namespace polynya::simulation::scenes
