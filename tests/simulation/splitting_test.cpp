// Splitting by the forces that contacts really carry (docs/theory/splitting.md).
#include "fracture/splitting.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "simulation/ship/pressing.hpp"
#include "simulation/world/world.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Vector;

constexpr double kOpeningOfStem = 0.633;  // per force ahead, of the reference ship with μ 0.2

double largest_force(const Simulation& simulation) {
  double largest = 0;
  for (const dynamics::Contact& c : simulation.world().step.contacts)
    largest = std::max(largest, length(c.impulse_on_b()) / simulation.scene().time.step);
  return largest;
}

TEST(Splitting, APlateOfTwentyKilometresSplitsWhenTheForceHasGrownToWhatItTakes) {
  // F = 2 σ_c h ξ tan α ahead, of which 0.633 opens the crack: ξ = F_max / (0.633 · 2 σ_c h tan 27°) = 2.20
  // m.
  const Scene scene = Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{1})).floe(rectangle(0.001, -1e4, 2e4, 1e4));
  const double needed = fracture::lefm_splitting_force(scene.ice, 2e4, 2e4);
  const double depth = needed / (kOpeningOfStem * 2 * 2.8e6 * 0.5 * std::tan(27 * kDegree));
  Simulation simulation(scene);
  double before = 0;
  Story story;
  while (story.events.empty() && simulation.time() < 5) {
    before = std::max(before, largest_force(simulation));
    simulation.step();
    listen(simulation, story);
  }
  ASSERT_EQ(story.splits().size(), 1u);
  const auto event = story.splits().front();
  EXPECT_NEAR(event.ice()->penetration / depth, 1, 0.02);
  EXPECT_NEAR(event.time / depth, 1, 0.02) << "at 1 m/s";
  const fracture::FailureCriteria& c = event.criteria();
  EXPECT_GE(c.opening_force, c.opening_capacity);
  EXPECT_LT(c.opening_force, 1.01 * c.opening_capacity) << "it grows by less in a step";
  EXPECT_LT(kOpeningOfStem * before, 1.001 * c.opening_capacity) << "no step before had it";
  EXPECT_NEAR(c.opening_capacity / needed, 1, 1e-3);
  EXPECT_NEAR(c.opening_force / c.contact_force, kOpeningOfStem, 1e-3);
  EXPECT_NEAR(c.flank_forces[0] / c.flank_forces[1], 1, 1e-3);
  EXPECT_NEAR(c.crack_length, 2e4, 5);
  EXPECT_NEAR(c.crack_width, 2e4, 5);
  EXPECT_EQ(c.fracture_toughness, scene.ice.fracture_toughness);
}

/// And a vertical hull never bends ice.
TEST(Splitting, ByTrueForcesUnlessAnotherRuleIsChosenAndNeverByNone) {
  EXPECT_EQ(Scene{}.fracture.splitting, fracture::SplittingModel::kLefm);
  for (const auto model :
       {fracture::SplittingModel::kLefm, fracture::SplittingModel::kMichel, fracture::SplittingModel::kNone}) {
    Scene scene = Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{4}, 4)).floe(rectangle(0.05, -15, 30.05, 15));
    scene.fracture.splitting = model;
    const Counts counts = run(scene, 3).simulation.counts();
    EXPECT_EQ(counts.splits > 0, model != fracture::SplittingModel::kNone);
    EXPECT_GT(counts.crush_contacts, 0);
    EXPECT_EQ(counts.bends, 0);
  }
}

TEST(Splitting, AFlatPushClosesTheMouthHoweverHard) {
  const Scene scene = Build().ship(barge({0, 0}, ConstantSpeed{1})).floe(rectangle(0.05, -10, 20.05, 10));
  Simulation simulation(scene);
  double largest = 0;
  while (simulation.time() < 3) {
    simulation.step();
    largest = std::max(largest, largest_force(simulation));
  }
  EXPECT_GT(largest, 3 * fracture::lefm_splitting_force(scene.ice, 20, 20));
  EXPECT_EQ(simulation.counts().splits, 0);
}

/// A floe of 60 × 30 m with a point of half-angle 30° at x = 0.
geometry::Polygon pointed(bool points_ahead) {
  const double d = 15 / std::tan(30 * kDegree);
  geometry::Polygon floe{{{0, 0}, {-d, 15}, {-60, 15}, {-60, -15}, {-d, -15}}, {}};
  if (!points_ahead)
    for (geometry::Point& p : floe.outer) p = {-60 - p.x, -p.y};
  return floe;
}

TEST(Splitting, AFloeSplitsAnotherWithItsPointAndNotWithItsSide) {
  for (const bool points_ahead : {true, false}) {
    const auto [simulation, story] =
        run_to_first_event(Build().floe(pointed(points_ahead), {1, 0}).floe(rectangle(0.05, -10, 20.05, 10)), 3);
    if (!points_ahead) {
      EXPECT_TRUE(story.events.empty());
      EXPECT_LT(simulation.floe_states()[0].velocity.x, 0.95) << "they met";
      continue;
    }
    ASSERT_EQ(story.splits().size(), 1u);
    const auto event = story.splits()[0];
    EXPECT_EQ(event.ship, -1);
    EXPECT_EQ(event.ice()->by_floe, 0);
    EXPECT_EQ(event.ice()->floe, 1);
    EXPECT_GE(event.criteria().opening_force, event.criteria().opening_capacity);
    EXPECT_NEAR(event.criteria().opening_capacity, fracture::lefm_splitting_force(simulation.scene().ice, 20, 20), 1e3);
    EXPECT_EQ(event.ice()->children.size(), 2u);
  }
}

TEST(Splitting, AFloeThatDriftsOnAStructureSplitsAtItsNoseAndNotAtItsWall) {
  for (const bool has_nose : {true, false}) {
    const geometry::Ring hull =
        has_nose ? wedge_bow_waterline(120, 24, 27 * kDegree) : rectangle(-60, -12, 60, 12).outer;
    const Story story =
        run_to_first_event(Build().structure(hull, {-60, 0}).floe(rectangle(0.05, -10, 20.05, 10), {-1, 0}), 3).story;
    EXPECT_EQ(story.events.size(), has_nose ? 1u : 0u);
    EXPECT_EQ(story.splits().size(), has_nose ? 1u : 0u);
    for (const auto& event : story.splits()) EXPECT_EQ(event.ship, 0);
  }
}

TEST(Splitting, TheFlanksOfABowOpenTheHeadOfTheSlotItIsIn) {
  // The bow touches nothing but the two corners of a slot of 10 m; the slot's head is 30 m on.
  const Story story =
      run_to_first_event(Build()
                             .ship(steep_icebreaker({9, 0}, ConstantSpeed{0.5}))
                             .floe({{{0, -40}, {80, -40}, {80, 40}, {0, 40}, {0, 5}, {30, 5}, {30, -5}, {0, -5}}, {}}),
                         10)
          .story;
  ASSERT_EQ(story.splits().size(), 1u);
  const auto event = story.splits()[0];
  EXPECT_NEAR(event.criteria().crack_length, 50, 0.1);
  EXPECT_NEAR(event.point_in_world.x, 30, 0.1) << "where ice begins, and not between the flanks";
  EXPECT_NEAR(event.point_in_world.y, 0, 0.1);
  EXPECT_EQ(event.ice()->children.size(), 2u);
}

/// A plate with its edge along x = 0 and an older channel, parallel to it, from `spacing` on.
geometry::Polygon between_channels(double spacing) {
  const double far = spacing + 10;
  const geometry::Point slot[] = {{spacing, -300}, {spacing, 250}, {far, 250}, {far, -300}};
  return {{{0.001, -300}, slot[0], slot[1], slot[2], slot[3], {800, -300}, {800, 300}, {0.001, 300}}, {}};
}

TEST(Splitting, BetweenParallelChannelsALongCrackRunsWhereTheyAreNearerThanSMax) {
  const auto first_at = [](double spacing) {
    return run_to_first_event(Build().ship(icebreaker({0, 0}, ConstantSpeed{0.5}, 0.5)).floe(between_channels(spacing)),
                              10)
        .story;
  };
  const Story far = first_at(700);
  ASSERT_FALSE(far.bends().empty());
  const fracture::FailureCriteria bend = far.bends()[0].criteria();
  ASSERT_GT(bend.opening_force, 0);
  EXPECT_LT(bend.opening_force, bend.opening_capacity);
  // S_max = (F_b / 0.2105 h K)², F_b what opens the crack when the ice bends.
  const double most = std::pow(bend.opening_force / (0.2105 * 0.5 * 150e3), 2);
  const Story near = first_at(0.85 * most);
  ASSERT_FALSE(near.splits().empty());
  const fracture::FailureCriteria split = near.splits()[0].criteria();
  EXPECT_NEAR(split.crack_length, 0.85 * most, 0.5) << "from the stem to the older channel";
  EXPECT_GT(split.crack_width, 2 * split.crack_length);
  EXPECT_FALSE(first_at(1.15 * most).bends().empty());
}

/// 36 floes of three to six corners that rush at each other.
Scene crowd(scenery::Random& random) {
  Build scene = Build().without_drag();
  for (int i = 0; i < 36; ++i) {
    const int row = i / 6;
    const Point middle{13.0 * (i % 6), 13.0 * row};
    const int corners = 3 + random.below(4);
    geometry::Polygon polygon;
    for (int k = 0; k < corners; ++k) {
      const auto turn = geometry::Rotation::by(2 * std::numbers::pi * (k + random.between(0, 0.4)) / corners);
      polygon.outer.push_back(middle + 6 * Vector{turn.cosine, turn.sine});
    }
    scene.floe(polygon, {random.between(-2, 2), random.between(-2, 2)});
  }
  return scene;
}

TEST(Splitting, WhatPassesFloesOverIsNoLessThanTheirPushes) {
  scenery::Random random(20170611);
  Simulation simulation(crowd(random));
  const World& world = simulation.world();
  int bounded = 0, corners = 0, sharp = 0;
  while (simulation.time() < 8) {
    simulation.step();
    for (const dynamics::Contact& c : world.step.contacts) {
      const double bound = opening_bound(world.setup, {&c, 1});
      for (const BodyIndex floe : {c.a, c.b}) {
        PressedFloe pressed;
        press(world.setup, world.population.bodies, {&c, 1}, floe, pressed);
        EXPECT_LE(pressed.most, bound * (1 + 1e-9));
        corners += !pressed.contacts.empty() && pressed.contacts.front().is_corner ? 1 : 0;
      }
      const auto is_sharp = [&](Point tip) { return dot(c.ends[0] - tip, c.ends[1] - tip) > 0; };
      bounded += std::isfinite(bound) ? 1 : 0;
      sharp += std::isfinite(bound) && (is_sharp(c.tip_of_a) || is_sharp(c.tip_of_b)) ? 1 : 0;
    }
  }
  EXPECT_GT(bounded, 1000);
  EXPECT_GT(sharp, 10);
  EXPECT_GT(corners, 1000);
}

}  // namespace
}  // namespace polynya::simulation
