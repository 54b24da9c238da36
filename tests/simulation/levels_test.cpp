// Steps by need (simulation/world/levels.hpp): parts of a tick where a hull goes fast through thin ice.

#include "simulation/world/levels.hpp"

#include <cmath>

#include <gtest/gtest.h>

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
  const auto scene = [](double thickness, double speed) {
    Scene of = in_level_ice(thickness, speed, 0.005);
    of.record.forces_interval = 0.1;
    return of;
  };
  EXPECT_EQ(default_tick(scene(0.5, 2)), 0.05);    // 8 × .075 m / 2 m/s = .3 s
  EXPECT_EQ(default_tick(scene(0.1, 8)), 0.01);    // 8 × .015 / 8 = .015
  EXPECT_EQ(default_tick(scene(2, 8)), 0.01);      // 8 × .0375/2 / 8 = .019
  EXPECT_EQ(default_tick(scene(0.01, 8)), 0.001);  // 8 × .0015 / 8 = .0015
  Scene one = scene(0.5, 2);
  one.time.levels = 0;
  EXPECT_EQ(default_tick(one), 0.025);  // .075 / 2 = .0375
  Scene recorded = scene(0.5, 2);
  recorded.record.frames_interval = 0.03;
  EXPECT_EQ(default_tick(recorded), 0.01);
  Scene drifting = scene(0.1, 2);
  drifting.water.drift = {-6, 0};
  EXPECT_EQ(default_tick(drifting), 0.01);  // 8 × .015 / 8 = .015
  Scene sailing = scene(0.5, 2);
  sailing.ships.front().propulsion = dynamics::Engine{.bollard_pull = 1e6, .open_water_speed = 20};
  EXPECT_EQ(default_tick(sailing), 0.025);  // the half of a circle, .5 / 20
  Scene moving = scene(0.5, 2);
  moving.floes.push_back(FloeSpec{rectangle(200, 0, 210, 10), {3, 0}, 0});
  EXPECT_EQ(default_tick(moving), 0.025);  // .075 / 3
  Scene pressed = scene(0.5, 2);
  pressed.walls.emplace_back().pressure = WallPressure{.line_load = 1e4};
  EXPECT_EQ(default_tick(pressed), 0.02);
  Scene turning = scene(0.5, 2);
  turning.floes.push_back(FloeSpec{rectangle(200, 0, 210, 10), {}, 1});
  EXPECT_EQ(default_tick(turning), 0.01);  // .25 / (1 × 14.1) = .018
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

}  // namespace
}  // namespace polynya::simulation::scenes
