// Overlaps that the gradient of their area does not show are ground to brash, with all accounts closed.
#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

Structure block(double x0, double y0, double x1, double y1) {
  Structure block = standing(barge({60, 0}, ConstantSpeed{0}));
  block.name = "block";
  block.hull.waterline = rectangle(x0, y0, x1, y1).outer;
  return block;
}

struct Ground {
  Simulation simulation;
  Story story;
  const Event& event() const { return story.events.at(0); }
};

Ground after_one_step(const Scene& scene) {
  Ground ground{Simulation(scene), {}};
  ground.simulation.step();
  listen(ground.simulation, ground.story);
  return ground;
}

TEST(Grind, APlankThroughAStripBecomesTwoAndTheOverlapBrash) {
  Scene scene;
  scene.structures = {block(-30, -1, 30, 1)};
  scene.floes = {floe(rectangle(-2, -10, 2, 8), {0, 0.3})};
  const Ground ground = after_one_step(scene);
  ASSERT_EQ(ground.story.events.size(), 1U);
  const Event& event = ground.event();
  EXPECT_TRUE(event.is<Grind>());
  EXPECT_EQ(event.ship, 0);
  EXPECT_EQ(event.ice()->by_floe, kNoFloe);
  EXPECT_EQ(event.ice()->children.size(), 2U);
  EXPECT_NEAR(event.ice()->brash_area, 8, 1e-9);
  EXPECT_NEAR(std::get<Grind>(event.what).criterion.overlap_area, 8, 1e-9);
  EXPECT_LT(std::get<Grind>(event.what).criterion.width, 1e-9);
  EXPECT_NEAR(std::get<Grind>(event.what).criterion.least_width, 0.25 * 8 / 4, 1e-9);
  EXPECT_EQ(ground.simulation.counts().ground, 1);
  const AreaLedger ledger = ground.simulation.area_ledger();
  EXPECT_NEAR(ledger.brash_area, 8, 1e-9);
  EXPECT_NEAR(ledger.imbalance, 0, 1e-12);
  EXPECT_TRUE(ground.simulation.audit().is_closed());
  EXPECT_GT(ground.simulation.audit().sums.energy.grinding, 0);
}

TEST(Grind, AFloeAllInsideAHullIsBrashAndAPileAllInsideAFloeLeavesItsHole) {
  Scene scene;
  scene.structures = {block(-30, -10, 30, 10)};
  scene.floes = {floe(rectangle(3, -2, 6, 2))};
  const Ground inside = after_one_step(scene);
  ASSERT_EQ(inside.story.events.size(), 1U);
  EXPECT_TRUE(inside.event().ice()->children.empty());
  EXPECT_EQ(inside.event().ice()->brash_area, 12);
  EXPECT_TRUE(inside.simulation.floe_states().empty());

  scene.structures = {block(-1, -1, 1, 1)};
  scene.floes = {floe(rectangle(-40, -40, 40, 40))};
  const Ground around = after_one_step(scene);
  ASSERT_EQ(around.story.events.size(), 1U);
  ASSERT_EQ(around.simulation.floe_states().size(), 1U);
  EXPECT_EQ(around.simulation.floe_states()[0].polygon_in_body->holes.size(), 1U);
  EXPECT_EQ(around.event().ice()->brash_area, 4);
  EXPECT_EQ(std::get<Grind>(around.event().what).criterion.overlap_area, 4) << "the smaller of the two";
}

TEST(Grind, OfTwoFloesTheSmallerIsGround) {
  Scene scene;
  scene.floes = {floe(rectangle(-20, -1, 20, 1), {0.1, 0}), floe(rectangle(-1, -12, 1, 12))};
  const Ground ground = after_one_step(scene);
  ASSERT_EQ(ground.story.events.size(), 1U);
  EXPECT_EQ(ground.event().ice()->floe, 1);
  EXPECT_EQ(ground.event().ice()->by_floe, 0);
  EXPECT_EQ(ground.event().ship, -1);
  EXPECT_EQ(ground.event().ice()->children.size(), 2U);
}

TEST(Grind, AWedgeIsPartedByItsContactInstead) {
  Scene scene;
  Structure wedge = block(0, 0, 1, 1);
  wedge.hull.waterline = {{5, 0}, {-25, 9}, {-25, -9}};
  scene.structures = {wedge};
  scene.floes = {floe(rectangle(0, -10, 1.5, 10), {-0.3, 0})};
  Simulation simulation(scene);
  const Story story = run(simulation, 2);
  EXPECT_TRUE(story.events.empty());
  EXPECT_GT(simulation.counts().crush_contacts, 0);
}

/// Two floes that touch at a corner, to the last bit and a little more or less.
TEST(Grind, WhatOnlyTouchesIsLeft) {
  for (const double off : {-1e-9, -1e-16, 0.0, 1e-16, 1e-9}) {
    Scene scene;
    const double x = 0.1 + off;
    scene.floes = {floe({{{0.1, 0.3}, {-20, 7}, {-20, -7}}, {}}, {1e-3, 0}),
                   floe({{{x, 0.3}, {30, -20}, {30, 20}}, {}})};
    const Ground ground = after_one_step(scene);
    EXPECT_TRUE(ground.story.events.empty()) << off;
  }
}

TEST(Grind, IsPartOfTheStateAndDoesNotDependOnThreads) {
  Scene scene;
  scene.structures = {block(-30, -1, 30, 1)};
  scene.floes = {floe(rectangle(-2, -10, 2, 8), {0, 0.3}), floe(rectangle(4, -10, 6, 8), {0.2, 0.3})};
  Simulation whole(scene);
  run(whole, 1);
  Simulation first(scene);
  run(first, 0.5);
  auto second = Simulation::resumed(scene, first.state());
  ASSERT_TRUE(second.has_value()) << second.error();
  second->set_threads(2);
  run(*second, 1);
  EXPECT_EQ(second->state_hash(), whole.state_hash());
  EXPECT_EQ(second->counts().ground, 2);
}

}  // namespace
}  // namespace polynya::simulation
