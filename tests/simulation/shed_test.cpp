// What contacts have crushed leaves the floe (docs/theory/contact.md).
#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

/// A thin floe that runs onto a pile with its side, and past it: it crushes more than h², and less than .5 %
/// of the pile.
Scene floe_past_pile() {
  Scene scene = Build().without_drag().unbreakable().pile({0, 0}, 10).floe(rectangle(4, 9.6, 34, 39.6), {-4, 0});
  scene.ice.thickness = 0.2;
  return scene;
}

/// A floe of 8 x 4 m between a vertical bow and a pier.
Scene squeezed_floe(Laws laws = Laws::kDefault) {
  return Build(laws)
      .unbreakable()
      .ship(barge({0, 0}, ConstantSpeed{0.1}, 0.1))
      .structure(rectangle(8.05, -20, 20, 20).outer)
      .floe(rectangle(0.05, -2, 8.05, 2));
}

double area_pressed(const Simulation& simulation) {
  double area = 0;
  for (const CrushedOverlap& overlap : simulation.crushed_overlaps()) area += overlap.area + overlap.tilted;
  return area;
}

TEST(Shed, WhatAContactCrushedIsCutOffWhereItPressedMost) {
  Simulation simulation(floe_past_pile());
  Story story;
  double most_pressed = 0;
  while (simulation.time() < 20 && story.grinds().empty()) {
    most_pressed = std::max(most_pressed, area_pressed(simulation));
    simulation.step();
    listen(simulation, story);
  }
  ASSERT_EQ(story.grinds().size(), 1U);
  const Event event = story.grinds()[0];
  const GrindCriterion& criterion = std::get<Grind>(event.what).criterion;
  EXPECT_EQ(event.ship, 0);
  EXPECT_EQ(event.ice()->children.size(), 1U);
  EXPECT_EQ(criterion.least_width, 0);
  EXPECT_GE(criterion.overlap_area, criterion.least_area);
  EXPECT_NEAR(criterion.overlap_area, most_pressed, 0.02 * most_pressed);
  const double brash = simulation.area_ledger().brash_area;
  EXPECT_NEAR(brash, criterion.overlap_area, 1e-9);
  const auto floes = simulation.floe_states();
  ASSERT_EQ(floes.size(), 1U);
  EXPECT_NEAR(floes[0].area, 900 - brash, 1e-9);
  const auto shared = geometry::shared_area(*floes[0].polygon_in_body, floes[0].world_from_body,
                                            {simulation.scene().structures[0].hull.waterline, {}},
                                            simulation.ship_states()[0].world_from_ship);
  ASSERT_TRUE(shared.has_value());
  EXPECT_LT(*shared, 1e-6);
  EXPECT_GT(simulation.audit().sums.energy.grinding, 0);
  EXPECT_GT(length(simulation.audit().sums.momentum.removed), 0);
  expect_closed(simulation);
}

TEST(Shed, TheForceOnAFloeThatStaysPressedDoesNotChange) {
  Simulation simulation(squeezed_floe());
  const Story story = run(simulation, 40);
  ASSERT_GT(story.grinds().size(), 3U);
  EXPECT_LT(area_pressed(simulation), 0.021 * simulation.floe_states()[0].area);
  const fracture::Ice& ice = simulation.scene().ice;
  const double force = ice.compressive_strength * ice.thickness * 4;
  EXPECT_NEAR(-mean(story, &HullSample::from_ice, 0, 10) / force, 1, 0.02);
  EXPECT_NEAR(-largest(story, &HullSample::from_ice_largest) / force, -1, 0.1);
  expect_closed(simulation);
}

TEST(Shed, TheRulesOfThePaperKeepCrushedIce) {
  const Trial done = run(squeezed_floe(Laws::kPaper), 20);
  EXPECT_TRUE(done.story.grinds().empty());
}

TEST(Shed, IsPartOfTheStateAndDoesNotDependOnThreads) {
  EXPECT_GE(expect_resumes(squeezed_floe(), 11, 20, 2).simulation.counts().ground, 1);
  EXPECT_EQ(expect_resumes(floe_past_pile(), 1, 15, 2).simulation.counts().ground, 1);
}

}  // namespace
}  // namespace polynya::simulation
