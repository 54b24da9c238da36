// Eq. (4), the finite-element table of the edge crack (docs/theory/splitting.md), and the forces that open a crack.
#include "fracture/splitting.hpp"

#include <cmath>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "tests/shapes.hpp"

namespace polynya::fracture {
namespace {

using geometry::Vector;

using shapes::kDegree;

TEST(Splitting, ThePapersPlateNeedsElevenMeganewtons) {
  EXPECT_NEAR(michel_splitting_force(Ice{}, 110, 0.25), 11e6, 1e-3);
  EXPECT_NEAR(michel_splitting_force(Ice{}, 440, 0.25), 44e6, 1e-3);
}

TEST(Splitting, LefmIsWithinThreePercentOfTheFiniteElements) {
  const double table[][2] = {{0.25, 0.092}, {0.5, 0.134}, {0.75, 0.163}, {1, 0.187},
                             {1.5, 0.208},  {2, 0.2105},  {3, 0.2105}};  // W/L, F_max / (h K √L)
  Ice ice;
  for (const double length : {1.0, 80.0, 2e4}) {
    for (const auto& [ratio, force] : table) {
      ice.thickness = 0.3 * length;
      const double scaled = lefm_splitting_force(ice, length, ratio * length) /
                            (ice.thickness * ice.fracture_toughness * std::sqrt(length));
      EXPECT_NEAR(scaled / force, 1, 0.03) << "W/L " << ratio;
    }
  }
}

TEST(Splitting, PiecesNarrowerOrSmallerThanTheLeastAreSlivers) {
  const LeastPiece least{0.5, 0.5};
  EXPECT_FALSE(leaves_sliver(least, 10, 20, 101, 300));
  EXPECT_TRUE(leaves_sliver(least, 10, 20, 99, 300)) << "20 m long, 4.95 m wide";
  EXPECT_TRUE(leaves_sliver(least, 10, 20, 300, 99));
  EXPECT_TRUE(leaves_sliver(least, 10, 4, 49, 300)) << "12 m wide, but 49 m²";
  EXPECT_TRUE(leaves_sliver({0, 0}, 10, 20, 0, 300)) << "a crack that parts nothing";
  EXPECT_FALSE(leaves_sliver({0, 0}, 10, 20, 1e-3, 300));
}

TEST(Splitting, OfAnArmBesideAFreeEdgeJoinsTheTableWithinWhatOneArmIsStiffer) {
  // studies/benches/crack_plate.py paths: 0.293 h K √b; the table's rule has 0.187 √(2b), of two arms.
  const Ice ice;
  for (const double b : {1.0, 20.0, 300.0}) {
    const double force = turning_crack_force(ice, b);
    EXPECT_NEAR(force / (ice.thickness * ice.fracture_toughness * std::sqrt(b)), 0.293, 1e-12);
    EXPECT_NEAR(force / lefm_splitting_force(ice, 100 * b, 2 * b), 1.108, 0.001);
  }
  EXPECT_NEAR(kTurningCrack.straight + 1 / std::tan(kTurningCrack.turn), 1.04, 1e-3) << "where it ends";
}

TEST(Splitting, AStripIsLongerThanEightTimesItsWidth) {
  EXPECT_TRUE(leaves_strip(100, 12.4 * 100, 1e4));
  EXPECT_TRUE(leaves_strip(100, 1e4, 12.4 * 100));
  EXPECT_FALSE(leaves_strip(100, 12.6 * 100, 1e4));
}

/// The faces of a wedge of that half-angle whose tip is at the origin and points along `direction`.
std::array<Face, 2> wedge(double half_angle, double direction, Vector velocity) {
  std::array<Face, 2> faces;
  for (const int side : {0, 1}) {
    const double turn = direction + (side == 0 ? 1 : -1) * (std::numbers::pi / 2 - half_angle);
    faces[side].normal = {std::cos(turn), std::sin(turn)};
    const double back = direction + (side == 0 ? 1 : -1) * (std::numbers::pi - half_angle);
    faces[side].middle = {std::cos(back), std::sin(back)};
    faces[side].slip = dot(velocity, perpendicular(faces[side].normal));
  }
  return faces;
}

double opening_per_force(double half_angle, double friction, double speed) {
  const auto pushes = wedge_pushes({1, 0}, wedge(half_angle, 0, {speed, 0}), friction);
  if (!pushes) return -1;
  EXPECT_NEAR(length((*pushes)[0].force + (*pushes)[1].force - Vector{1, 0}), 0, 1e-12);
  const Opening opening = opening_of(*pushes, {}, {1, 0});
  EXPECT_NEAR(opening.left, opening.right, 1e-12);
  return std::min(opening.left, opening.right);
}

TEST(Opening, OfTheReferenceStemIsAsDerived) {
  EXPECT_NEAR(opening_per_force(27 * kDegree, 0.2, 1), 0.633, 5e-4);
  EXPECT_NEAR(opening_per_force(27 * kDegree, 0.0, 1), 0.981, 5e-4);
  for (const double degrees : {5.0, 20.0, 45.0, 70.0}) {
    const double t = std::tan(degrees * kDegree);
    EXPECT_NEAR(opening_per_force(degrees * kDegree, 0.3, 2), (1 - 0.3 * t) / (2 * (t + 0.3)), 1e-12);
  }
}

TEST(Opening, FrictionActsWithTheSlip) {
  const double still = opening_per_force(27 * kDegree, 0.2, 0);
  EXPECT_NEAR(still, opening_per_force(27 * kDegree, 0, 1), 1e-12) << "nothing slips";
  EXPECT_GT(opening_per_force(27 * kDegree, 0.2, -1), still) << "a wedge on its way out pulls the faces along";
  EXPECT_LT(opening_per_force(80 * kDegree, 0.2, 1), 0) << "blunter than atan 1/μ it closes the crack";
}

TEST(Opening, DoesNotDependOnTheFrame) {
  for (const double turn : {0.4, 2.0, -2.7}) {
    const Vector ahead{std::cos(turn), std::sin(turn)};
    const auto pushes = wedge_pushes(3e5 * ahead, wedge(27 * kDegree, turn, 0.5 * ahead), 0.2);
    ASSERT_TRUE(pushes);
    EXPECT_NEAR(opening_of(*pushes, {}, ahead).force(), 3e5 * opening_per_force(27 * kDegree, 0.2, 0.5), 1e-6);
  }
}

TEST(Opening, AWedgeThatBearsOnOneFaceIsNotTwoPushes) {
  EXPECT_FALSE(wedge_pushes({0, 1}, wedge(27 * kDegree, 0, {1, 0}), 0.2));
  EXPECT_TRUE(wedge_pushes({1, 0.3}, wedge(27 * kDegree, 0, {1, 0}), 0.2));
  EXPECT_FALSE(wedge_pushes({1, 0}, wedge(90 * kDegree, 0, {0, 0}), 0.2)) << "a flat face";
}

TEST(Opening, IsThatOfTheWeakerSideAndNoneWhereASideIsPushedAgainstTheOther) {
  const auto opening = [](const std::vector<Push>& pushes) { return opening_of(pushes, {}, {1, 0}); };
  const Opening apart = opening({{{0, 1}, {5, 30}}, {{-4, -2}, {5, -20}}});
  EXPECT_NEAR(apart.left, 30, 1e-12);
  EXPECT_NEAR(apart.right, 20, 1e-12);
  EXPECT_NEAR(apart.force(), 20, 1e-12);
  EXPECT_EQ(opening({{{0, 1}, {5, -30}}, {{0, -2}, {5, 20}}}).force(), 0) << "together";
  EXPECT_EQ(opening({{{0, 1}, {5, 30}}, {{0, 2}, {5, 20}}}).force(), 0) << "on one side";
  EXPECT_EQ(opening({{{-1, 1}, {50, 0}}, {{-1, -1}, {50, 0}}}).force(), 0) << "a flat push";
}

TEST(Opening, ASternsFaceThatLeavesTheIceDoesNotPress) {
  // The corner of a stern: its side presses to the left, and its transom leaves the ice behind it.
  std::array<Face, 2> stern{{{{5, 0}, {0, 1}, 2, 0}, {{0, -5}, {-1, 0}, 0.3, 0}}};
  EXPECT_TRUE(wedge_pushes({-1, 1}, stern, 0.1)) << "at rest along its heading";
  stern[1].leaving = 2;
  EXPECT_FALSE(wedge_pushes({-1, 1}, stern, 0.1)) << "under way";
  stern[1].leaving = -2;
  EXPECT_TRUE(wedge_pushes({-1, 1}, stern, 0.1)) << "astern";
}

}  // namespace
}  // namespace polynya::fracture
