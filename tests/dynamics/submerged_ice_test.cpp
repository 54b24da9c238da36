// What ice under a hull takes from its ship, against Lindqvist's resistance.
#include "dynamics/water/submerged_ice.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace polynya::dynamics {
namespace {

constexpr double kDegree = std::numbers::pi / 180;
constexpr HullForm kReference{
    .length = 120, .beam = 24, .draught = 6, .stem_angle = 30 * kDegree, .entrance_angle = 27 * kDegree};

TEST(SubmergedIce, ThePathOfTheReferenceShipIsLindqvists) {
  const SubmersionPath path = submersion_path(kReference);
  EXPECT_NEAR(path.rise, 5.0, 5e-4);
  EXPECT_NEAR(path.sliding, 70.83, 5e-3);
  EXPECT_NEAR(path.bow, 6 / std::tan(30 * kDegree), 1e-12);
  // R_s = δρ g h B (z̄ + μ s̄): 58.9 kN potential, 166.8 kN friction.
  const double weight = 100 * 9.81 * 0.5 * 24;  // per metre of way [N/m]
  EXPECT_NEAR(weight * path.rise, 58.9e3, 50);
  EXPECT_NEAR(weight * 0.2 * path.sliding, 166.8e3, 50);
}

TEST(SubmergedIce, APieceHasRisenAndSlidAllTheWayHoweverItIsCutIntoSteps) {
  const SubmersionPath path = submersion_path(kReference);
  double risen = 0, slid = 0;
  for (double s = -0.3; s < 130;) {
    const double to = s + 0.0137;
    risen += path.risen_over(s, to);
    slid += path.slid_over(s, to);
    s = to;
  }
  EXPECT_NEAR(risen, path.rise, 1e-12);
  EXPECT_NEAR(slid, path.sliding, 1e-11);
}

TEST(SubmergedIce, AHullCoveredWithIcePaysLindqvistsResistance) {
  const SubmersionPath path = submersion_path(kReference);
  const double mu = 0.2, speed = 1, dt = 0.01, piece = 0.5;  // a piece every half metre
  const double weight = 100 * 9.81 * 0.5 * 24 * piece;       // of each [N]
  double work = 0;
  for (int step = 0; step < 50; ++step) {  // over one spacing of the pieces
    for (double s = step * dt * speed; s < 120; s += piece)
      work += weight * (path.risen_over(s, s + speed * dt) + mu * path.slid_over(s, s + speed * dt));
  }
  EXPECT_NEAR(work / (50 * dt * speed), 225.6e3, 0.01 * 225.6e3);
}

TEST(SubmergedIce, TheSpeedFactorIsLindqvists) {
  EXPECT_EQ(submersion_speed_factor(0, 120), 1);
  EXPECT_NEAR(submersion_speed_factor(1, 120), 1 + 9.4 / std::sqrt(9.81 * 120), 1e-12);
}

}  // namespace
}  // namespace polynya::dynamics
