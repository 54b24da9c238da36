// Steps by need (simulation/world/levels.hpp): parts of a tick where a hull goes fast through thin ice.
#include "simulation/world/levels.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "simulation/state/state.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation::scenes {
namespace {

/// A ship of 40 m by 8 m in fast ice of that thickness, 20 m of it.
Scene in_level_ice(double thickness, double speed, double step) {
  Build scene;
  Ship ship = icebreaker({0, 0}, ConstantSpeed{speed}, speed);
  ship.hull.waterline = wedge_bow_waterline(40, 8, 25 * kDegree);
  ship.hull.draught = 3;
  ship.position_in_world = {-20.5, 0};
  scene.step(step).ship(ship).floe(fast(rectangle(0, -12, 30, 12)));
  scene.ice.thickness = thickness;
  scene.fracture.splitting = fracture::SplittingModel::kNone;
  scene.fracture.cusp_fate = CuspFate::kUnderHull;
  scene.record.forces_interval = step;
  return scene;
}

/// Over 10 m of ice, once the bow is in it [N].
double mean_surge(const Scene& scene) {
  const double speed = scene.ships.front().speed;
  const Trial trial = run(scene, 20.5 / speed);
  EXPECT_TRUE(trial.simulation.audit().is_closed());
  return -mean(trial.story, &HullSample::from_ice, 0, 10.5 / speed);
}

Scene with_one_step(Scene scene, double step) {
  scene.time.levels = 0;
  scene.time.step = scene.record.forces_interval = step;
  return scene;
}

TEST(Levels, NoLoadFallsWhereAHullGoesFasterThanATickBreaksIce) {
  const Scene scene = in_level_ice(0.1, 8, 0.005);
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
    Scene scene = in_level_ice(thickness, speed, 0.005);
    scene.record.forces_interval = 0.1;
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
  EXPECT_EQ(tick(0.5, 2, [](Scene& s) { s.walls.emplace_back().pressure = WallPressure{.line_load = 1e4}; }), 0.02);
}

TEST(Levels, AFewThinFloesDoNotChooseTheTick) {
  Scene scene = in_level_ice(0.5, 8, 0.005);
  scene.record.forces_interval = 0.1;
  const double tick = default_tick(scene);
  scene.own_ice.assign(1, scene.ice);
  scene.own_ice.front().thickness = 0.05;
  scene.floes.push_back(FloeSpec{rectangle(100, 0, 105, 5), {}, 0});  // 25 m² of 745
  scene.floes.back().own_ice = 0;
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

Scene with_levels(Scene scene, int levels) {
  scene.time.levels = levels;
  return scene;
}

/// Ticks that were taken in steps of several, at least: steps of a whole block count as 32.
std::int64_t ticks_in_longer(const Simulation& simulation) {
  const auto& steps = simulation.counts().steps_at_level;
  std::int64_t ticks = 0;
  for (int k = 1; k <= kMostLevels; ++k) ticks += steps[static_cast<std::size_t>(kMostLevels + k)] << k;
  return ticks;
}

/// A ship into loose floes, and far from it floes that drift together and touch.
Scene voyage_and_drift() {
  Build scene;
  scene.step(0.02).ship(icebreaker({0, 0}, ConstantSpeed{2}, 2));
  scene.grid({2, -63}, 4, 6, 20, 21);
  scene.floe(rectangle(0, 100, 8, 108), {0.1, 0}).floe(rectangle(9, 101, 17, 109), {-0.05, 0.02}, 0.002);
  scene.floe(rectangle(8, 110, 20, 118), {0, -0.1});
  scene.ice.thickness = 0.5;
  return scene;
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
  const Scene scene = with_levels(voyage_and_drift(), 0);
  Simulation ticks(scene);
  skip(ticks, 400);
  Simulation asked(scene);
  go_to(asked, 400);
  EXPECT_EQ(asked.state(), ticks.state());
  EXPECT_EQ(ticks_in_longer(asked), 0);
}

TEST(Components, OfSlowFloesEndWhereOneStepForAllHasThem) {
  Build scene;
  scene.step(0.005);
  scene.floe(rectangle(0, 0, 10, 10), {0.2, 0.01}).floe(rectangle(10.3, 1, 20, 12), {-0.1, 0}, 0.004);
  scene.floe(rectangle(20.5, -3, 30, 9), {-0.05, 0});
  Simulation fine(with_levels(scene, 0));
  Simulation coarse(scene);
  go_to(fine, 4000);
  go_to(coarse, 4000);
  EXPECT_GT(ticks_in_longer(coarse), 1500);
  EXPECT_LT(coarse.counts().body_steps, fine.counts().body_steps / 5);
  EXPECT_LT(coarse.counts().energy_created, 1e-6);
  expect_closed(coarse);
  const auto a = coarse.floe_states(), b = fine.floe_states();
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < b.size(); ++i) {
    EXPECT_NEAR(distance(a[i].world_from_body.position, b[i].world_from_body.position), 0, 0.05);  // of 4 m
    EXPECT_NEAR(a[i].angle, b[i].angle, 0.005);
    EXPECT_NEAR(length(a[i].velocity - b[i].velocity), 0, 0.004);
  }
}

TEST(Components, GoByTheTickWhereAFastBodyComesNear) {
  Build scene;
  scene.step(0.02).without_drag();
  scene.floe(rectangle(0, 0, 10, 10), {0.01, 0}).floe(rectangle(30, 2, 34, 6), {-2.5, 0});
  scene.ice.thickness = 0.5;
  Simulation fine(with_levels(scene, 0));
  Simulation coarse(scene);
  double deepest_fine = 0;
  double deepest = 0;
  bool was_coarse = false;
  for (std::int64_t tick = 20; tick <= 600; tick += 20) {
    go_to(fine, tick);
    go_to(coarse, tick);
    for (const auto& overlap : fine.crushed_overlaps()) deepest_fine = std::max(deepest_fine, overlap.area);
    for (const auto& overlap : coarse.crushed_overlaps()) deepest = std::max(deepest, overlap.area);
    was_coarse = was_coarse || ticks_in_longer(coarse) > 0;
  }
  EXPECT_TRUE(was_coarse);
  EXPECT_GT(deepest_fine, 0);
  EXPECT_NEAR(deepest, deepest_fine, 0.1 * deepest_fine);
  const auto a = fine.floe_states();
  const auto b = coarse.floe_states();
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_NEAR(length(a[i].velocity - b[i].velocity), 0, 0.02);
}

TEST(Components, LeaveWhatAShipTouchesToTheTick) {
  Build scene;
  scene.step(0.02).ship(barge({0, 0}, ConstantSpeed{0.05}, 0.05));
  scene.floe(rectangle(0.001, -5, 10, 5)).floe(rectangle(10.001, -5, 20, 5)).floe(rectangle(100, 0, 110, 10), {0.1, 0});
  Simulation simulation(scene);
  go_to(simulation, 500);
  const auto& components = simulation.world().components;
  EXPECT_EQ(components.of_level[0], (std::vector<BodyIndex>{0, 1, 2}));  // and what that touches
  EXPECT_EQ(simulation.world().population.awake.size(), 4U);
  EXPECT_FALSE(validate_world(simulation.world()));
}

/// A slow ship that pushes a row of floes, all near each other.
Scene pushed_row(int floes) {
  Build scene;
  scene.step(0.02).ship(barge({0, 0}, ConstantSpeed{0.05}, 0.05));
  for (int i = 0; i < floes; ++i) scene.floe(rectangle(0.2 + 10.004 * i, -5, 10.2 + 10.004 * i, 5));
  return scene;
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
  Simulation fine(with_levels(pushed_row(14), 0));
  Simulation coarse(pushed_row(14));
  for (const std::int64_t tick : {500, 2000, 4000}) {
    go_to(fine, tick);
    go_to(coarse, tick);
    const auto a = coarse.floe_states(), b = fine.floe_states();
    for (std::size_t i = 0; i < b.size(); ++i) {
      EXPECT_NEAR(distance(a[i].world_from_body.position, b[i].world_from_body.position), 0, 0.1) << tick;  // of 4 m
      EXPECT_NEAR(length(a[i].velocity - b[i].velocity), 0, 0.003) << tick << ' ' << i;
    }
  }
  EXPECT_LT(coarse.counts().body_steps, 0.9 * static_cast<double>(fine.counts().body_steps));
  const double crushed = fine.audit().sums.energy.crushing;
  EXPECT_LT(coarse.counts().energy_created, 1e-4 * crushed);
  EXPECT_NEAR(coarse.audit().sums.energy.crushing, crushed, 0.01 * crushed);
  expect_closed(coarse);
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
