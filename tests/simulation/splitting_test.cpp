// Splitting of floes by the actual forces of contacts (docs/theory/splitting.md), and slender floes that break across
// (docs/theory/beams.md).
#include "fracture/splitting.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "fracture/characteristic_length.hpp"
#include "simulation/ship/pressing.hpp"
#include "simulation/world/world.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Point;
using geometry::Polygon;
using geometry::Vector;

constexpr double kOpeningOfStem = 0.633;  // per force ahead, of the reference ship with μ 0.2

/// Steps until something splits, or until a time. Returns the largest force before that [N].
double largest_before_split(const Scene& scene, double until) {
  Simulation simulation(scene);
  double largest = 0;
  while (simulation.counts().splits == 0 && simulation.time() < until) {
    for (const dynamics::Contact& c : simulation.world().data.contacts)
      largest = std::max(largest, length(c.impulse_on_b()) / scene.time.step);
    simulation.step();
  }
  return largest;
}

/// A floe of 20 m, its edge before x = 0.
const geometry::Polygon kFloeOfTwenty = rectangle(0.05, -10, 20.05, 10);

TEST(Splitting, APlateOfTwentyKilometresSplitsWhenTheForceHasGrownToWhatItTakes) {
  // Ahead F = 2 σ_c h ξ tan α, of which 0.633 opens the crack. Therefore ξ = F_max / (0.633 · 2 σ_c h tan 27°) = 2.20
  // m.
  const Scene scene = Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{1})).floe(rectangle(0.001, -1e4, 2e4, 1e4));
  const double needed = fracture::lefm_splitting_force(scene.ice, 2e4, 2e4);
  const double depth = needed / (kOpeningOfStem * 2 * 2.8e6 * 0.5 * std::tan(27 * kDegree));
  const Event event = only(run_to_first_event(scene, 5).story.splits());
  EXPECT_NEAR(event.ice()->penetration / depth, 1, 0.02);
  EXPECT_NEAR(event.time / depth, 1, 0.02) << "at 1 m/s";
  const fracture::FailureCriteria& c = event.criteria();
  EXPECT_GE(c.opening_force, c.opening_capacity);
  EXPECT_LT(c.opening_force, 1.01 * c.opening_capacity) << "it grows by less in a step";
  EXPECT_LT(kOpeningOfStem * largest_before_split(scene, 5), 1.001 * c.opening_capacity) << "no step before had it";
  EXPECT_NEAR(c.opening_capacity / needed, 1, 1e-3);
  EXPECT_NEAR(c.opening_force / c.contact_force, kOpeningOfStem, 1e-3);
  EXPECT_NEAR(c.flank_forces[0] / c.flank_forces[1], 1, 1e-3);
  EXPECT_NEAR(c.crack_length, 2e4, 5);
  EXPECT_NEAR(c.crack_width, 2e4, 5);
  EXPECT_EQ(c.fracture_toughness, scene.ice.fracture_toughness);
}

TEST(Splitting, AFlatPushClosesTheMouthHoweverHard) {
  const Scene scene = Build().ship(barge({0, 0}, ConstantSpeed{1})).floe(kFloeOfTwenty);
  EXPECT_GT(largest_before_split(scene, 3), 3 * fracture::lefm_splitting_force(scene.ice, 20, 20));
  EXPECT_TRUE(run(scene, 3).story.splits().empty());
}

/// Returns a floe of 60 × 30 m with a point of half-angle 30° at x = 0.
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
        run_to_first_event(Build().floe(pointed(points_ahead), {1, 0}).floe(kFloeOfTwenty), 3);
    if (!points_ahead) {
      EXPECT_TRUE(story.events.empty());
      EXPECT_LT(simulation.floe_states()[0].velocity.x, 0.95) << "they met";
      continue;
    }
    const Event event = only(story.splits());
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
    const Ship ship = has_nose ? icebreaker({}, ConstantSpeed{}) : barge({}, ConstantSpeed{});
    const Story story =
        run_to_first_event(Build().structure(ship.hull.waterline, {-60, 0}).floe(kFloeOfTwenty, {-1, 0}), 3).story;
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
  const Event event = only(story.splits());
  EXPECT_NEAR(event.criteria().crack_length, 50, 0.1);
  EXPECT_NEAR(event.point_in_world.x, 30, 0.1) << "where ice begins, and not between the flanks";
  EXPECT_NEAR(event.point_in_world.y, 0, 0.1);
  EXPECT_EQ(event.ice()->children.size(), 2u);
}

/// Returns a plate with its edge along x = 0 and an older channel parallel to it, from `spacing` on.
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
  // S_max = (F_b / 0.2105 h K)², where F_b is the force that opens the crack when the ice bends.
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
  int bounded = 0, corners = 0, sharp = 0;
  run(crowd(random), 8, [&](const Simulation& simulation) {
    const World& world = simulation.world();
    for (const dynamics::Contact& c : world.data.contacts) {
      const double bound = opening_bound(world.setup, world.last_step, {&c, 1});
      for (const BodyIndex floe : {c.a, c.b}) {
        PressedFloe pressed{.floe = floe};
        press(world.setup, world.last_step, world.population.bodies, {&c, 1}, pressed);
        EXPECT_LE(pressed.most, bound * (1 + 1e-9));
        corners += !pressed.contacts.empty() && pressed.contacts.front().is_corner ? 1 : 0;
      }
      const auto is_sharp = [&](Point tip) { return dot(c.ends[0] - tip, c.ends[1] - tip) > 0; };
      bounded += std::isfinite(bound) ? 1 : 0;
      sharp += std::isfinite(bound) && (is_sharp(c.tip_of_a) || is_sharp(c.tip_of_b)) ? 1 : 0;
    }
  });
  EXPECT_GT(bounded, 1000);
  EXPECT_GT(sharp, 10);
  EXPECT_GT(corners, 1000);
}

/// Returns a floe of three to seven corners that drifts onto two structures beside each other, piles or wedges.
Scene on_two_structures(scenery::Random& random) {
  const double size = random.between(8, 60);
  Build scene = Build().without_drag().step(random.between(0.02, 0.1)).thickness(random.between(0.3, 1.5));
  const int corners = 3 + random.below(5);
  geometry::Polygon polygon;
  for (int k = 0; k < corners; ++k) {
    const auto turn = geometry::Rotation::by(2 * std::numbers::pi * (k + random.between(0, 0.4)) / corners);
    polygon.outer.push_back(Point{0, 0} + size * Vector{turn.cosine, turn.sine});
  }
  scene.floe(polygon, {random.between(0.5, 3), 0}, random.between(-0.05, 0.05));
  const double gap = random.between(0.05, 0.8) * size;
  for (const double side : {-1.0, 1.0}) {
    const Point at{1.02 * size + random.between(0, 0.3), side * gap + random.between(-0.1, 0.1) * size};
    const double width = random.between(0.5, 3);
    if (random.below(2) == 0)
      scene.pile(at, width);
    else
      scene.structure({{0, 0}, {2 * width, -width}, {2 * width, width}}, at);
  }
  return scene;
}

/// A split runs at the force of its criterion within 5 %, also if several contacts press and some let go as others are
/// stopped. Less than one split in a hundred is not found.
TEST(Splitting, OfAFloeOnTwoStructuresRunsAtTheForceThatItTakes) {
  scenery::Random random(20170611);
  std::int64_t splits = 0, unresolved = 0;
  for (int i = 0; i < 1000; ++i) {
    const auto [simulation, story] = run(on_two_structures(random), 10);
    for (const Event& event : story.splits()) {
      const fracture::FailureCriteria& c = event.criteria();
      if (c.section_stress > 0) continue;  // it breaks as a beam
      EXPECT_GE(c.opening_force, c.opening_capacity * (1 - 1e-9));
      EXPECT_LE(c.opening_force, c.opening_capacity * 1.051);
    }
    splits += std::ssize(story.splits());
    unresolved += simulation.counts().unresolved_splits;
  }
  EXPECT_GT(splits, 500);
  EXPECT_LT(unresolved, 0.01 * static_cast<double>(splits)) << splits << " splits";
}

// ---- cracks beside free edges, through holes and at the corners of sterns

const double kCharacteristicLength = fracture::characteristic_length(fracture::Ice{}, fracture::Water{});  // [m]

/// The stem meets a large plate at a distance from the edge on its right.
Story beside_edge(double distance) {
  return run_to_first_event(
             Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{1})).floe(rectangle(0.001, -distance, 400, 400)), 2)
      .story;
}

TEST(TurningCrack, EndsAtTheEdgeBesideItAndPartsACompactPiece) {
  // In this test the turning crack leaves no sliver, and no straight crack to the edge runs; each would leave one.
  const double b = 1.03 * kCharacteristicLength;
  const Story story = beside_edge(b);
  const Event event = only(story.splits());
  const fracture::FailureCriteria& c = event.criteria();
  EXPECT_NEAR(c.opening_capacity / fracture::turning_crack_force(fracture::Ice{}, b), 1, 0.01);
  EXPECT_GE(c.opening_force, c.opening_capacity);
  EXPECT_NEAR(c.crack_width / b, 2, 0.02);
  EXPECT_NEAR(c.crack_length / b, 0.63 + 1 / std::sin(1.1817), 0.02);
  EXPECT_NEAR(least_child(story, event) / (b * b), 0.835, 0.015) << "as by finite elements";
}

TEST(TurningCrack, DoesNotRunWhereItWouldLeaveASliver) {
  const double b = 0.85 * kCharacteristicLength;
  for (const auto& event : beside_edge(b).splits())
    EXPECT_GT(event.criteria().opening_capacity, 2 * fracture::turning_crack_force(fracture::Ice{}, b));
}

TEST(TurningCrack, NoSplitLeavesAStrip) {
  // A plate of a kilometre, entered 40 m from its side by a hull that only crushes and splits.
  const auto [simulation, story] = run(
      Build().step(0.01).ship(steep_icebreaker({0, 0}, ConstantSpeed{3}, 3)).floe(rectangle(0.01, -40, 1000, 960)), 60);
  ASSERT_GT(story.splits().size(), 2u);
  for (const auto& event : story.splits()) {
    const double length = event.criteria().crack_length;
    EXPECT_LE(length, 8.001 * least_child(story, event) / length) << "at " << event.time;
  }
}

TEST(Splitting, ACrackThroughAHoleBreaksEachStretchByACriterionOfItsOwn) {
  // Along the crack there are 20 m of ice, a hole of 10 m and 30 m of ice. F_max is that of 30 m, neither that of 20 m
  // nor that of 50 m.
  Polygon plate = rectangle(0.001, -200, 60, 200);
  plate.holes = {{{20, -5}, {20, 5}, {30, 5}, {30, -5}}};
  const Story story =
      run_to_first_event(Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{0.5})).floe(plate), 3).story;
  const Event event = only(story.splits());
  const fracture::FailureCriteria& c = event.criteria();
  EXPECT_NEAR(c.crack_length, 30, 1e-6);
  EXPECT_NEAR(c.opening_capacity / fracture::lefm_splitting_force(fracture::Ice{}, 30, 400), 1, 1e-6);
  EXPECT_GE(c.opening_force, c.opening_capacity);
  EXPECT_LT(c.opening_force, 1.05 * c.opening_capacity);
  EXPECT_EQ(event.ice()->children.size(), 2u);
}

TEST(Splitting, CracksBeginOutsideOfThePileThatOpensThem) {
  const Story story = run(Build().step(0.01).pile({0, 0}, 5).floe(rectangle(5.01, -60, 125, 60), {-1.5, 0}), 30).story;
  ASSERT_GT(story.splits().size(), 0u);
  for (const auto& event : story.splits())
    EXPECT_GT(std::hypot(event.point_in_world.x, event.point_in_world.y), 4.9) << "at " << event.time;
}

TEST(Splitting, ASternsCornerOpensNoCrackWhileItsTransomLeavesTheIce) {
  // A rear corner of a box lies on an edge that rises by a tenth along the side of the box. The floe drifts onto it. If
  // the box moves, its side carries the load.
  const Polygon ice{{{-220, 2.05}, {120, 36.05}, {80, 336}, {-260, 302}}, {}};
  const auto splits = [&](double speed) {
    return run(Build().ship(barge({0, 0}, ConstantSpeed{speed}, speed)).floe(ice, {0, -0.4}), 2).story.splits().size();
  };
  EXPECT_GT(splits(0), 0u);
  EXPECT_EQ(splits(2), 0u);
}

// ---- slender floes below κ l

constexpr double kThickness = 1.6;  // [m]
constexpr double kWidth = 3;        // [m]
constexpr double kBeamLength = 24;  // [m]

/// Returns ice that floats freely ahead of a ship's stem, across it.
Build across(const Ship& ship, double length = kBeamLength, double step = 0.002, Laws laws = Laws::kDefault) {
  return Build(laws)
      .thickness(kThickness)
      .step(step)
      .ship(ship)
      .floe(rectangle(0.01, -length / 2, 0.01 + kWidth, length / 2));
}

Ship steep_ship(double speed = 3) {
  return steep_icebreaker({0, 0}, ConstantSpeed{speed}, speed);
}

/// Returns the force at which the stress in the middle section reaches σ_f, if the bending moment is `share` · F Λ [N].
double breaking_force(double share) {
  return fracture::Ice{}.flexural_strength * kThickness * kWidth * kWidth / 6 / (share * kBeamLength);
}

TEST(Beams, ALongFloeAcrossAStemBreaksInTheMiddleAndAShortOneDoesNot) {
  Ship ship = icebreaker({0, 0}, ConstantSpeed{3}, 3);
  for (const double draught : {0.0, 6.0}) {  // with it the floe tilts
    ship.hull.draught = draught;
    const auto [simulation, story] = run(across(ship), 3);
    ASSERT_GE(story.splits().size(), 1u) << draught;
    const Event event = story.splits()[0];
    EXPECT_EQ(event.ship, 0);
    EXPECT_EQ(event.ice()->floe, 0);
    EXPECT_EQ(event.ice()->children.size(), 2u);
    EXPECT_NEAR(event.criteria().crack_length, kWidth, 1e-6);
    EXPECT_LT(event.criteria().floe_size, event.criteria().breakable_size);
    EXPECT_NEAR(least_child(story, event), kBeamLength * kWidth / 2, 1);
    expect_closed(simulation);
    EXPECT_EQ(run(across(ship, 4), 3).story.splits().size(), 0u) << draught;
  }
}

/// Compares M = F Λ/8 with σ_f h w²/6 for a hull that does not press down. The floe breaks at the instant at which both
/// are equal.
TEST(Beams, AFreeFloeBreaksAtTheForceOfTheClosedForm) {
  for (const double step : {0.001, 0.005, 0.02}) {
    const Trial trial = run_to_first_event(across(steep_ship(), kBeamLength, step), 1);
    const fracture::FailureCriteria c = only(trial.story.splits()).criteria();
    EXPECT_GE(c.split_share(), 1) << step;
    EXPECT_LE(c.split_share(), 1.05) << step;
    EXPECT_NEAR(c.contact_force / c.split_share() / breaking_force(1.0 / 8), 1, 1e-3) << step;
    EXPECT_EQ(trial.simulation.counts().unresolved_splits, 0);
  }
}

/// Half of that force breaks a floe between a stem and two floes at rest: M = F Λ/4.
TEST(Beams, AFloeBetweenThreeBreaksAtHalfOfThat) {
  Build scene = across(steep_ship(0.3));
  for (const double y : {-12.0, 11.9}) scene.floe(fast(rectangle(0.01 + kWidth, y, 20, y + 0.1)));
  const fracture::FailureCriteria c = only(run_to_first_event(scene, 3).story.splits()).criteria();
  EXPECT_NEAR(c.contact_force / c.split_share() / breaking_force(1.0 / 4), 1, 0.05);
}

/// If a face pushes at an edge along the floe rather than across it, the force is off the axis of the floe by half its
/// width. It bends the near end and compresses the rest. Each break is in the ice.
TEST(Beams, BreakWithinTheFloe) {
  const Story story = run(across(steep_ship(), kBeamLength, 0.001), 2).story;
  for (const Event& event : story.splits()) {
    EXPECT_LT(std::abs(event.point_in_world.y), 20);
    EXPECT_LT(event.point_in_world.x, 3 * event.time + 5);
    EXPECT_GT(least_child(story, event), 4) << event.time;
  }
  EXPECT_LE(story.splits().size(), 3u);
}

TEST(Beams, AreKeptWholeWhereTheSceneSaysSo) {
  for (const Scene& scene : {across(steep_ship()).unbreakable(), across(steep_ship()).without_splits(),
                             across(steep_ship(), kBeamLength, 0.002, Laws::kPaper)})
    EXPECT_TRUE(run(scene, 1).story.splits().empty());
}

TEST(Beams, AreTheSameAfterAResume) {
  EXPECT_GE(expect_resumes(across(icebreaker({0, 0}, ConstantSpeed{3}, 3)), 0.02, 1).story.splits().size(), 1u);
}

}  // namespace
}  // namespace polynya::simulation
