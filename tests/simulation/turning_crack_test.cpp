// Cracks beside free edges, through holes and at the corners of sterns (docs/theory/splitting.md).
#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "fracture/characteristic_length.hpp"
#include "fracture/splitting.hpp"
#include "simulation/world/world.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;
using geometry::Polygon;

const double kCharacteristicLength = fracture::characteristic_length(fracture::Ice{}, fracture::Water{});  // [m]

/// The stem meets a large plate at a distance from the edge on its right.
Story beside_edge(double distance) {
  return run_to_first_event(
             Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{1})).floe(rectangle(0.001, -distance, 400, 400)), 2)
      .story;
}

TEST(TurningCrack, EndsAtTheEdgeBesideItAndPartsACompactPiece) {
  // Here what turns leaves no sliver, and no straight crack to the edge: each would leave one.
  const double b = 1.03 * kCharacteristicLength;
  const Story story = beside_edge(b);
  ASSERT_EQ(story.splits().size(), 1u);
  const auto event = story.splits()[0];
  const fracture::FailureCriteria& c = event.criteria();
  EXPECT_NEAR(c.opening_capacity / fracture::turning_crack_force(fracture::Ice{}, b), 1, 0.01);
  EXPECT_GE(c.opening_force, c.opening_capacity);
  EXPECT_NEAR(c.crack_width / b, 2, 0.02);
  EXPECT_NEAR(c.crack_length / b, 0.63 + 1 / std::sin(1.1817), 0.02);
  double least = 1e9;
  for (const Birth& birth : story.births)
    if (birth.parent != kNoFloe) least = std::min(least, birth.area);
  EXPECT_NEAR(least / (b * b), 0.835, 0.015) << "as by finite elements";
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
    double least = 1e9;
    for (const Birth& birth : story.births)
      if (std::ranges::count(event.ice()->children, birth.floe) > 0) least = std::min(least, birth.area);
    const double length = event.criteria().crack_length;
    EXPECT_LE(length, 8.001 * least / length) << "at " << event.time;
  }
}

TEST(Splitting, ACrackThroughAHoleBreaksEachStretchByACriterionOfItsOwn) {
  // 20 m of ice, a hole of 10 m and 30 m of ice: F_max of 30 m, neither that of 20 m nor that of 50 m.
  Polygon plate = rectangle(0.001, -200, 60, 200);
  plate.holes = {{{20, -5}, {20, 5}, {30, 5}, {30, -5}}};
  const Story story =
      run_to_first_event(Build().ship(steep_icebreaker({0, 0}, ConstantSpeed{0.5})).floe(plate), 3).story;
  ASSERT_EQ(story.splits().size(), 1u);
  const auto event = story.splits()[0];
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
  // A box's rear corner lies on an edge that rises by a tenth along its side; the floe drifts onto it. Under
  // way the side bears.
  const Polygon ice{{{-220, 2.05}, {120, 36.05}, {80, 336}, {-260, 302}}, {}};
  const auto splits = [&](double speed) {
    return run(Build().ship(barge({0, 0}, ConstantSpeed{speed}, speed)).floe(ice, {0, -0.4}), 2).story.splits().size();
  };
  EXPECT_GT(splits(0), 0u);
  EXPECT_EQ(splits(2), 0u);
}

}  // namespace
}  // namespace polynya::simulation
