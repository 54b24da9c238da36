// Steps by need (simulation/world/levels.hpp): parts of a tick where a hull goes fast through thin ice.
#include "simulation/world/levels.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/state/state.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// A ship of 40 m by 8 m in fast ice of that thickness, 20 m of it.
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

/// Over 10 m of ice, once the bow is in it [N].
double mean_surge(const Scene& scene) {
  const double speed = scene.ships.front().speed;
  const Trial trial = run(scene, 20.5 / speed);
  EXPECT_TRUE(trial.simulation.audit().is_closed());
  return -mean(trial.story, &HullSample::from_ice, 0, 10.5 / speed);
}

Scene with_one_step(const Build& scene, double step) {
  return Build(scene).step(step).one_step_for_all().recorded_each_step();
}

TEST(Levels, NoLoadFallsWhereAHullGoesFasterThanATickBreaksIce) {
  const Build scene = in_level_ice(0.1, 8, 0.005);
  const double fine = mean_surge(with_one_step(scene, 0.005 / 64));
  EXPECT_NEAR(mean_surge(scene), fine, 0.05 * fine);
  EXPECT_LT(mean_surge(with_one_step(scene, 0.005)), 0.9 * fine);  // the hull passes through
}

/// Mirror images, the ice at both sides of a bow breaks at the same instant.
TEST(Levels, APlateBendsOnBothSidesOfABowInOneStep) {
  const Trial trial = run(with_one_step(in_level_ice(0.5, 1, 0.005), 0.005), 10);
  ASSERT_GT(trial.simulation.counts().bends, 4);
  const double surge = mean(trial.story, &HullSample::from_ice);
  double sway = 0;
  for (const HullSample& sample : trial.story.samples) sway = std::max(sway, std::abs(sample.from_ice.sway));
  EXPECT_LT(sway, 1e-3 * std::abs(surge));
}

TEST(Levels, ATickHasPartsWhereIceIsThinAndOnlyThere) {
  const auto finest = [](double thickness) {
    Simulation simulation(in_level_ice(thickness, 8, 0.005));
    while (simulation.time() < 1) skip(simulation);
    const auto& steps = simulation.counts().steps_at_level;
    int level = 0;
    while (steps[static_cast<std::size_t>(level)] == 0) ++level;
    return level - kMostLevels;
  };
  EXPECT_LE(finest(0.1), -2);
  EXPECT_EQ(finest(0.5), 0);
}

TEST(Levels, ARunStopsWithinItsTicksAndGoesOnToTheSameState) {
  expect_resumes(in_level_ice(0.1, 4, 0.005), 217 * 0.005, 400 * 0.005, 3);
}

/// By hand from docs/theory/steps.md.
TEST(Levels, ATickIsChosenBySpeedThicknessAndWhatIsRecorded) {
  const auto tick = [](double thickness, double speed, auto change) {
    Scene scene = in_level_ice(thickness, speed, 0.005).recorded_every(0.1);
    change(scene);
    return default_tick(scene);
  };
  const auto as_it_is = [](Scene&) {};
  const dynamics::Engine fast_engine{.bollard_pull = 1e6, .open_water_speed = 20};
  const FloeSpec sliding = floe(rectangle(200, 0, 210, 10), {3, 0}), spinning = floe(sliding.polygon_in_world, {}, 1);
  EXPECT_EQ(tick(0.5, 2, as_it_is), 0.05);                              // 8 × .075 m / 2 m/s = .3 s
  EXPECT_EQ(tick(0.1, 8, as_it_is), 0.01);                              // 8 × .015 / 8 = .015
  EXPECT_EQ(tick(2, 8, as_it_is), 0.01);                                // 8 × .0375/2 / 8 = .019
  EXPECT_EQ(tick(0.01, 8, as_it_is), 0.001);                            // 8 × .0015 / 8 = .0015
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.time.levels = 0; }), 0.025);  // .075 / 2 = .0375
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.record.frames_interval = 0.03; }), 0.01);
  EXPECT_EQ(tick(0.1, 2, [](Scene& s) { s.water.drift.x = -6; }), 0.01);                   // 8 × .015 / 8 = .015
  EXPECT_EQ(tick(0.5, 2, [&](Scene& s) { s.ships[0].propulsion = fast_engine; }), 0.025);  // half a circle, .5 / 20
  EXPECT_EQ(tick(0.5, 2, [&](Scene& s) { s.floes.push_back(sliding); }), 0.025);           // .075 / 3
  EXPECT_EQ(tick(0.5, 2, [&](Scene& s) { s.floes.push_back(spinning); }), 0.01);           // .25 / (1 × 14.1) = .018
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.walls.emplace_back().pressure = WallPressure{.line_load = 1e4}; }), 0.025);
}

TEST(Levels, AFewThinFloesDoNotChooseTheTick) {
  Build scene = in_level_ice(0.5, 8, 0.005).recorded_every(0.1);
  const double tick = default_tick(scene);
  scene.floe(rectangle(100, 0, 105, 5)).of({.thickness = 0.05});  // 25 m² of 745
  EXPECT_EQ(default_tick(scene), tick);
  scene.floes.back().polygon_in_world = rectangle(100, 0, 105, 100);
  EXPECT_LT(default_tick(scene), tick);
}

TEST(Levels, AreNoneByRigidImpulses) {
  Scene scene = in_level_ice(0.1, 4, 0.005);
  scene.contact.law = ContactLaw::kImpulse;
  Simulation simulation(scene);
  skip(simulation, 200);
  EXPECT_EQ(simulation.counts().steps_at_level[kMostLevels], 200);
}

// ---- bodies that take several ticks in one step

constexpr std::int64_t kMany = 1 << 20;

/// To a tick, by the steps that the bodies need.
void go_to(Simulation& simulation, std::int64_t tick) {
  while (simulation.steps() < tick && !simulation.numerical_failure()) {
    simulation.step(tick - simulation.steps());
    simulation.journal().clear();
  }
}

/// Ticks that were taken in steps of several, at least: steps of a whole block count as 32.
std::int64_t ticks_in_longer(const Simulation& simulation) {
  const auto& steps = simulation.counts().steps_at_level;
  std::int64_t ticks = 0;
  for (int k = 1; k <= kMostLevels; ++k) ticks += steps[static_cast<std::size_t>(kMostLevels + k)] << k;
  return ticks;
}

/// A ship into loose floes, and far from it floes that drift together and touch.
Build voyage_and_drift() {
  return Build()
      .step(0.02)
      .ship(icebreaker({0, 0}, ConstantSpeed{2}, 2))
      .grid({2, -63}, 4, 6, 20, 21)
      .floe(rectangle(0, 100, 8, 108), {0.1, 0})
      .floe(rectangle(9, 101, 17, 109), {-0.05, 0.02}, 0.002)
      .floe(rectangle(8, 110, 20, 118), {0, -0.1});
}

TEST(Components, AreTheSameOnThreadsAndAfterAKill) {
  const Scene scene = voyage_and_drift();
  Simulation through(scene);
  go_to(through, 1500);
  EXPECT_GT(ticks_in_longer(through), 500);
  EXPECT_GT(through.counts().bends + through.counts().splits, 0);
  for (const int threads : {2, 3, 8}) {
    Simulation threaded(scene);
    threaded.set_threads(threads);
    go_to(threaded, 1500);
    EXPECT_EQ(threaded.state_hash(), through.state_hash()) << threads;
  }
  Simulation first(scene);
  while (first.steps() < 707) first.step(1500 - first.steps());
  Simulation again = resumed(scene, first);
  go_to(again, 1500);
  EXPECT_EQ(again.state_hash(), through.state_hash());
  EXPECT_EQ(again.counts().steps_at_level, through.counts().steps_at_level);
  expect_closed(through);
}

TEST(Components, HaveOneStepForAllAtNoLevel) {
  const Scene scene = voyage_and_drift().one_step_for_all();
  Simulation ticks(scene);
  skip(ticks, 400);
  Simulation asked(scene);
  go_to(asked, 400);
  EXPECT_EQ(asked.state(), ticks.state());
  EXPECT_EQ(ticks_in_longer(asked), 0);
}

/// A scene by the steps that its bodies need, and in one step for all.
struct CoarseAndFine {
  explicit CoarseAndFine(const Build& scene) : coarse(scene), fine(Build(scene).one_step_for_all()) {}
  void go_to(std::int64_t tick) {
    for (Simulation* simulation : {&coarse, &fine}) scenes::go_to(*simulation, tick);
  }
  /// How far the floes of the one are from those of the other, in place [m], angle and velocity [m/s].
  void expect_near(double place, double angle, double velocity) const {
    const auto a = coarse.floe_states(), b = fine.floe_states();
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t i = 0; i < b.size(); ++i) {
      SCOPED_TRACE(testing::Message() << "floe " << i << " at " << fine.time());
      EXPECT_LT(distance(a[i].world_from_body.position, b[i].world_from_body.position), place);
      EXPECT_NEAR(a[i].angle, b[i].angle, angle);
      EXPECT_LT(length(a[i].velocity - b[i].velocity), velocity);
    }
  }

  Simulation coarse, fine;
};

TEST(Components, OfSlowFloesEndWhereOneStepForAllHasThem) {
  CoarseAndFine both(Build()
                         .step(0.005)
                         .floe(rectangle(0, 0, 10, 10), {0.2, 0.01})
                         .floe(rectangle(10.3, 1, 20, 12), {-0.1, 0}, 0.004)
                         .floe(rectangle(20.5, -3, 30, 9), {-0.05, 0}));
  both.go_to(4000);
  EXPECT_GT(ticks_in_longer(both.coarse), 1500);
  EXPECT_LT(both.coarse.counts().body_steps, both.fine.counts().body_steps / 5);
  EXPECT_LT(both.coarse.counts().energy_created, 1e-6);
  expect_closed(both.coarse);
  both.expect_near(0.05, 0.005, 0.004);  // of 4 m
}

TEST(Components, GoByTheTickWhereAFastBodyComesNear) {
  CoarseAndFine both(Build()
                         .step(0.02)
                         .without_drag()
                         .floe(rectangle(0, 0, 10, 10), {0.01, 0})
                         .floe(rectangle(30, 2, 34, 6), {-2.5, 0}));
  double deepest_fine = 0, deepest = 0;
  for (std::int64_t tick = 20; tick <= 600; tick += 20) {
    both.go_to(tick);
    for (const auto& overlap : both.fine.crushed_overlaps()) deepest_fine = std::max(deepest_fine, overlap.area);
    for (const auto& overlap : both.coarse.crushed_overlaps()) deepest = std::max(deepest, overlap.area);
  }
  EXPECT_GT(ticks_in_longer(both.coarse), 0);
  EXPECT_GT(deepest_fine, 0);
  EXPECT_NEAR(deepest, deepest_fine, 0.1 * deepest_fine);
  both.expect_near(1, 0.1, 0.02);
}

TEST(Components, LeaveWhatAShipTouchesToTheTick) {
  Simulation simulation(Build()
                            .step(0.02)
                            .ship(barge({0, 0}, ConstantSpeed{0.05}, 0.05))
                            .floe(rectangle(0.001, -5, 10, 5))
                            .floe(rectangle(10.001, -5, 20, 5))
                            .floe(rectangle(100, 0, 110, 10), {0.1, 0}));
  go_to(simulation, 500);
  const auto& components = simulation.world().components;
  EXPECT_EQ(components.of_level[0], (std::vector<BodyIndex>{0, 1, 2}));  // and what that touches
  EXPECT_EQ(simulation.world().population.awake.size(), 4U);
  EXPECT_FALSE(validate_world(simulation.world()));
}

/// A slow ship that pushes a row of floes, all near each other.
Build pushed_row(int floes) {
  return Build().step(0.02).ship(barge({0, 0}, ConstantSpeed{0.05}, 0.05)).grid({0.2, -5}, floes, 1, 10, 10.004);
}

TEST(Components, OfARowHaveLongerStepsFartherFromTheShip) {
  Simulation simulation(pushed_row(14));
  const auto& level = simulation.world().population.bodies.level;
  int longer = 0;  // where a wave of pressure runs through the row, all go by the tick
  for (std::int64_t tick = 500; tick <= 4000; tick += 250) {
    go_to(simulation, tick);
    EXPECT_EQ(level[1], 0) << tick;
    longer += level[14] >= 2 ? 1 : 0;
  }
  EXPECT_EQ(simulation.world().population.awake.size(), 15U);
  EXPECT_GE(longer, 8);
  EXPECT_FALSE(simulation.world().components.touching.empty());
  expect_closed(simulation);
}

TEST(Components, OfARowMoveAsInOneStepForAll) {
  CoarseAndFine both(pushed_row(14));
  for (const std::int64_t tick : {500, 2000, 4000}) {
    both.go_to(tick);
    both.expect_near(0.1, 1e-3, 0.003);  // of 4 m
  }
  EXPECT_LT(both.coarse.counts().body_steps, 0.9 * static_cast<double>(both.fine.counts().body_steps));
  const double crushed = both.fine.audit().sums.energy.crushing;
  EXPECT_LT(both.coarse.counts().energy_created, 1e-4 * crushed);
  EXPECT_NEAR(both.coarse.audit().sums.energy.crushing, crushed, 0.01 * crushed);
  expect_closed(both.coarse);
}

TEST(Components, AreAllAtOneTickWhereFramesAreDue) {
  Scene scene = voyage_and_drift();
  scene.record.frames_interval = 0.14;
  Simulation simulation(scene);
  std::int64_t frames = 0;
  while (simulation.steps() < 700) {
    simulation.step(kMany);
    frames += simulation.steps() % 7 == 0 ? 1 : 0;
  }
  EXPECT_EQ(frames, simulation.steps() / 7);
  EXPECT_GT(ticks_in_longer(simulation), 0);
}

}  // namespace
}  // namespace polynya::simulation::scenes
