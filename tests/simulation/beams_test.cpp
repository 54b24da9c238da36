// Slender floes below κ l that break across (docs/theory/beams.md).
#include <algorithm>

#include <gtest/gtest.h>

#include "simulation/world/world.hpp"
#include "tests/simulation/scenes.hpp"

namespace polynya::simulation {
namespace {

using namespace scenes;

constexpr double kThickness = 1.6;  // [m]
constexpr double kWidth = 3;        // [m]
constexpr double kBeamLength = 24;  // [m]

/// Ice that floats free ahead of a ship's stem, across it.
Build across(const Ship& ship, double length, double step = 0.002) {
  Build scene;
  scene.ice.thickness = kThickness;
  scene.step(step).ship(ship).floe(rectangle(0.01, -length / 2, 0.01 + kWidth, length / 2));
  return scene;
}

/// By which its middle section comes to σ_f, at a quarter or an eighth of F Λ [N].
double breaking_force(double share) {
  return fracture::Ice{}.flexural_strength * kThickness * kWidth * kWidth / 6 / (share * kBeamLength);
}

TEST(Beams, ALongFloeAcrossAStemBreaksInTheMiddleAndAShortOneDoesNot) {
  Ship ship = icebreaker({0, 0}, ConstantSpeed{3}, 3);
  for (const double draught : {0.0, 6.0}) {  // with it the floe tilts
    ship.hull.draught = draught;
    const auto [simulation, story] = run(across(ship, kBeamLength), 3);
    ASSERT_GE(story.splits().size(), 1u) << draught;
    const Event event = story.splits()[0];
    EXPECT_EQ(event.ship, 0);
    EXPECT_EQ(event.ice()->floe, 0);
    EXPECT_EQ(event.ice()->children.size(), 2u);
    EXPECT_NEAR(event.criteria().crack_length, kWidth, 1e-6);
    EXPECT_LT(event.criteria().floe_size, event.criteria().breakable_size);
    for (const Birth& birth : story.births) {
      if (birth.parent == 0) {
        EXPECT_NEAR(birth.area, kBeamLength * kWidth / 2, 1);
      }
    }
    expect_closed(simulation);
    EXPECT_EQ(run(across(ship, 4), 3).story.splits().size(), 0u) << draught;
  }
}

/// M = F Λ/8 against σ_f h w²/6, where the hull presses nothing down; at the instant at which it comes to that.
TEST(Beams, AFreeFloeBreaksAtTheForceOfTheClosedForm) {
  for (const double step : {0.001, 0.005, 0.02}) {
    const Trial trial = run_to_first_event(across(steep_icebreaker({0, 0}, ConstantSpeed{3}, 3), kBeamLength, step), 1);
    ASSERT_EQ(trial.story.splits().size(), 1u) << step;
    const fracture::FailureCriteria c = trial.story.splits()[0].criteria();
    EXPECT_GE(c.split_share(), 1) << step;
    EXPECT_LE(c.split_share(), 1.05) << step;
    EXPECT_NEAR(c.contact_force / c.split_share() / breaking_force(1.0 / 8), 1, 1e-3) << step;
    EXPECT_EQ(trial.simulation.counts().unresolved_splits, 0);
  }
}

/// Between a stem and two floes that stand it takes half of that: M = F Λ/4.
TEST(Beams, AFloeBetweenThreeBreaksAtHalfOfThat) {
  Build scene = across(steep_icebreaker({0, 0}, ConstantSpeed{0.3}, 0.3), kBeamLength);
  for (const double y : {-12.0, 11.9}) scene.floe(fast(rectangle(0.01 + kWidth, y, 20, y + 0.1)));
  const Trial trial = run_to_first_event(scene, 3);
  ASSERT_EQ(trial.story.splits().size(), 1u);
  const fracture::FailureCriteria c = trial.story.splits()[0].criteria();
  EXPECT_NEAR(c.contact_force / c.split_share() / breaking_force(1.0 / 4), 1, 0.05);
}

/// Where a face pushes at an edge, along the floe rather than across it, the force is off the floe's axis by half
/// its width: it bends the end that it is at, and presses the rest. Each break is in the ice.
TEST(Beams, BreakWithinTheFloe) {
  const Trial trial = run(across(steep_icebreaker({0, 0}, ConstantSpeed{3}, 3), kBeamLength, 0.001), 2);
  for (const Event& event : trial.story.splits()) {
    EXPECT_LT(std::abs(event.point_in_world.y), 20);
    EXPECT_LT(event.point_in_world.x, 3 * event.time + 5);
    for (const Birth& birth : trial.story.births) {
      if (std::ranges::count(event.ice()->children, birth.floe) > 0) {
        EXPECT_GT(birth.area, 4) << event.time;
      }
    }
  }
  EXPECT_LE(trial.story.splits().size(), 3u);
}

TEST(Beams, AreKeptWholeWhereTheSceneSaysSo) {
  const Ship ship = steep_icebreaker({0, 0}, ConstantSpeed{3}, 3);
  EXPECT_TRUE(run(across(ship, kBeamLength).unbreakable(), 1).story.splits().empty());
  Build none = across(ship, kBeamLength);
  none.fracture.splitting = fracture::SplittingModel::kNone;
  EXPECT_TRUE(run(none, 1).story.splits().empty());
  Build paper(Laws::kPaper);
  paper.ice.thickness = kThickness;
  paper.step(0.002).ship(ship).floe(across(ship, kBeamLength).floes[0]);
  EXPECT_TRUE(run(paper, 1).story.splits().empty());
}

TEST(Beams, AreTheSameAfterAResume) {
  const Scene scene = across(icebreaker({0, 0}, ConstantSpeed{3}, 3), kBeamLength);
  EXPECT_GE(expect_resumes(scene, 0.02, 1).story.splits().size(), 1u);
}

}  // namespace
}  // namespace polynya::simulation
