// Steps by need (simulation/world/levels.hpp): parts of a tick where a hull goes fast through thin ice.

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
  EXPECT_LT(mean_surge(with_one_step(scene, 0.005)), 0.5 * fine);  // the hull passes through
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
  EXPECT_EQ(finest(1), 0);
}

TEST(Levels, ARunStopsWithinItsTicksAndGoesOnToTheSameState) {
  expect_resumes(in_level_ice(0.1, 4, 0.005), 217 * 0.005, 400 * 0.005, 3);
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
