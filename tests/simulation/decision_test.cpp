// Section 8 of docs/theory.md, exercised: which floes break under which hull, and how.
#include <algorithm>

#include <gtest/gtest.h>

#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

Scene ship_against(const Ship& ship, const geometry::Polygon& ice) {
  Scene scene = paper_scene();
  scene.ships = {ship};
  scene.floes = {floe(ice)};
  return scene;
}

TEST(Decision, AFloeSmallerThanTheBreakableSizeIsPushedNeverBroken) {
  // √area just below l = 8.909 m by its definition; 40 m below 79.4 m as printed.
  for (const bool as_printed : {false, true}) {
    const double size = as_printed ? 40 : 8.9;
    Scene scene = ship_against(icebreaker({0, 0}, ConstantSpeed{2}),
                               rectangle(0.1, -0.3 * size, 0.1 + size, 0.7 * size));
    if (as_printed) scene.fracture.characteristic_length = fracture::CharacteristicLength::kAsPrinted;
    Simulation simulation(scene);
    const Story story = run(simulation, 20);
    EXPECT_TRUE(story.events.empty());
    EXPECT_EQ(simulation.counts().floes_final, 1);
    EXPECT_GT(distance(simulation.floe_states()[0].world_from_body.position, {}), 1) << "it was pushed";
  }
}

TEST(Decision, ThePapersPlateIsKnifeEdge) {
  // A central hit at 1 m/s gives j/τ_c = 10.9 MN against F_s = 11 MN: a hit 2 % faster splits, one at 1 m/s
  // does not.
  for (const double speed : {1.0, 1.02}) {
    Scene scene =
        ship_against(icebreaker({0, 0}, ConstantThrust{0}, speed), rectangle(0.001, -100, 110.001, 100));
    Simulation simulation(scene);
    const Story story = run(simulation, 0.5);
    const double peak = std::max_element(story.samples.begin(), story.samples.end(),
                                         [](const ShipSample& p, const ShipSample& q) {
                                           return std::abs(p.collision.surge) < std::abs(q.collision.surge);
                                         })
                            ->collision.surge;
    EXPECT_NEAR(std::abs(peak), 1.1 * speed / (1e-7 + 1 / (900 * 0.5 * 110 * 200)) / 0.5, 0.01e6);
    if (speed == 1.0) {
      EXPECT_NEAR(std::abs(peak), 10.945e6, 0.01e6);
      EXPECT_EQ(simulation.counts().splits, 0);
      continue;
    }
    ASSERT_FALSE(story.events.empty());
    const Event& event = story.events.front();
    EXPECT_TRUE(event.is<Split>());
    EXPECT_NEAR(event.criteria().splitting_force, 11e6, 1e4);
    EXPECT_NEAR(event.criteria().crack_length, 110, 0.1);
    EXPECT_GT(event.criteria().collision_force, event.criteria().splitting_force);
    EXPECT_EQ(event.ice()->children.size(), 2u);
    double area = 0;
    for (const Birth& birth : story.births) area += birth.time == event.time ? birth.area : 0;
    EXPECT_NEAR(area, 110 * 200, 1e-9);
  }
}

TEST(Decision, LefmSplitsWhereMichelDoesNotAndStatesBothSides) {
  for (const auto model : {fracture::SplittingModel::kMichel, fracture::SplittingModel::kLefm}) {
    Scene scene = ship_against(icebreaker({0, 0}, ConstantThrust{0}, 0.5), rectangle(0.001, -30, 50.001, 30));
    scene.fracture.splitting = model;
    scene.ice.fracture_toughness = 50e3;
    Simulation simulation(scene);
    const Story story = run(simulation, 1);
    const bool is_lefm = model == fracture::SplittingModel::kLefm;
    EXPECT_EQ(simulation.counts().splits > 0, is_lefm);
    for (const Event& event : story.events) {
      EXPECT_GT(event.criteria().contact_force, 0);
      EXPECT_EQ(event.criteria().splitting_force > 0, !is_lefm) << "F_s of Eq. (4)";
      if (!event.is<Split>()) continue;
      EXPECT_GE(event.criteria().opening_force, event.criteria().opening_capacity);
      EXPECT_GT(event.criteria().opening_capacity, 0);
      EXPECT_FALSE(event.criteria().pares);
      EXPECT_GE(event.criteria().floe_size, event.criteria().breakable_size);
    }
  }
}

TEST(Decision, AnInclinedBowBendsWhenItsVerticalForceReachesTheCapacity) {
  Scene scene = ship_against(icebreaker({0, 0}, ConstantSpeed{1}), rectangle(0.5, -100, 60.5, 100));
  Simulation simulation(scene);
  const Story story = run(simulation, 20);
  EXPECT_GT(simulation.counts().bends, 3);
  EXPECT_EQ(simulation.counts().rejected_cuts, 0);
  for (const Event& event : story.events) {
    if (!event.is<Bend>()) continue;
    EXPECT_GT(event.criteria().vertical_force, 0);
    EXPECT_GE(event.criteria().vertical_force, event.criteria().bending_capacity);
    EXPECT_GE(event.criteria().floe_size, event.criteria().breakable_size);
    EXPECT_GT(std::get<Bend>(event.what).cusp_radius, 0);
    EXPECT_LT(std::get<Bend>(event.what).cusp_radius, 2 * 8.909);
    EXPECT_GT(event.ice()->penetration, 0);
    EXPECT_NEAR(length(event.ice()->normal_in_world), 1, 1e-12);
  }
}

TEST(Decision, AVerticalHullOnlyCrushes) {
  Scene scene = ship_against(barge({0, 0}, ConstantSpeed{0.3}), rectangle(0.1, -100, 60.1, 100));
  scene.fracture.splitting = fracture::SplittingModel::kNone;
  Simulation simulation(scene);
  const Story story = run(simulation, 20);
  EXPECT_TRUE(story.events.empty());
  EXPECT_GT(simulation.counts().crush_contacts, 0);
  EXPECT_EQ(simulation.counts().floes_final, 1);
}

TEST(Decision, CuspsSubmergeOrFloat) {
  Event first[2];
  for (const CuspFate fate : {CuspFate::kSubmerge, CuspFate::kFloat}) {
    Scene scene = ship_against(icebreaker({0, 0}, ConstantSpeed{1}), rectangle(0.5, -60, 60.5, 60));
    scene.fracture.cusp_fate = fate;
    Simulation simulation(scene);
    Story story;
    while (story.events.empty() && simulation.time() < 20) {
      simulation.step();
      listen(simulation, story);
    }
    ASSERT_FALSE(story.events.empty());
    const Event& event = story.events.front();
    ASSERT_TRUE(event.is<Bend>());
    first[static_cast<int>(fate)] = event;
    double area = 0;
    for (const FloeState& state : simulation.floe_states()) area += state.area;
    if (fate == CuspFate::kSubmerge) {
      EXPECT_GT(event.ice()->submerged_area, 0);
      EXPECT_NEAR(area + event.ice()->submerged_area + event.ice()->brash_area, 7200, 1e-9);
      EXPECT_EQ(simulation.counts().floated_cusps, 0);
    } else {
      EXPECT_EQ(event.ice()->submerged_area, 0);
      EXPECT_NEAR(area + event.ice()->brash_area, 7200, 1e-9);
      EXPECT_EQ(simulation.counts().floated_cusps, 1);
    }
  }
  EXPECT_EQ(first[0].time, first[1].time) << "until the first cusp nothing differs";
  EXPECT_EQ(std::get<Bend>(first[0].what).cusp_radius, std::get<Bend>(first[1].what).cusp_radius);
  EXPECT_EQ(first[0].ice()->children.size() + 1, first[1].ice()->children.size());
}

TEST(Decision, ARejectedCutIsRecordedCountedAndLeavesTheFloe) {
  // A plate whose far edge crosses itself: no valid floe, and so no cut of it is either.
  const geometry::Polygon crossed{{{0.5, -30}, {60, -30}, {60, 30}, {40, 30}, {45, 35}, {45, 29}, {0.5, 30}},
                                  {}};
  Scene scene = ship_against(icebreaker({0, 0}, ConstantSpeed{1}), crossed);
  Simulation simulation(scene);
  const Story story = run(simulation, 5);
  const Counts counts = simulation.counts();
  EXPECT_GT(counts.rejected_cuts, 0);
  EXPECT_EQ(counts.rejected_cuts, static_cast<std::int64_t>(story.events.size()));
  for (const Event& event : story.events) {
    EXPECT_TRUE(event.is<RejectedCut>());
    EXPECT_NE(std::get<RejectedCut>(event.what).reason.find("invalid"), std::string::npos)
        << std::get<RejectedCut>(event.what).reason;
    EXPECT_TRUE(event.ice()->children.empty());
  }
  EXPECT_EQ(counts.bends + counts.splits, 0);
  EXPECT_EQ(counts.floes_final, 1);
  EXPECT_NEAR(simulation.area_ledger().imbalance, 0, 1e-9);
}

}  // namespace
}  // namespace polynya::simulation
