// Rudders behind propellers: published foils, and the momentum that a race has.
#include "dynamics/ship/rudder.hpp"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "tests/shapes.hpp"

namespace polynya::dynamics {
namespace {

using shapes::kDegree;

constexpr double kSeaDensity = 1000;
constexpr double kThrust = 1.2e6;

/// The rudder of the reference ship, behind a propeller whose diameter is 0.65 of the draught.
constexpr Rudder kRudder{.area = 12.96, .position = -60, .propeller_area = 11.95};

Rudder without_race() {
  Rudder rudder = kRudder;
  rudder.propeller_area = 0;
  return rudder;
}

double size(const Planar& force) {
  return std::hypot(force.surge, force.sway);
}

// ---- the blade in an endless flow

/// Lift and drag over ½ρ V² A up to stall by [Brix1993], equations 1.2.1 to 1.2.11, with C_Q = 1 and no friction.
LiftAndDrag by_brix(double aspect_ratio, double incidence) {
  const double s = std::sin(incidence), a = aspect_ratio;
  const double lift = 2 * M_PI * a * (a + 1) / ((a + 2) * (a + 2)) * s + s * s * std::cos(incidence);
  return {lift, 1.1 * lift * lift / (M_PI * a) + s * s * s};
}

/// Two published sets, of other model tests than [WhickerFehlner1958], and one measured point.
TEST(RudderFoil, HasTheLiftAndDragOfPublishedRudders) {
  for (const double aspect_ratio : {1.0, 1.5, 2.0, 3.0})
    for (const double degrees : {5.0, 10.0, 15.0, 20.0}) {
      const LiftAndDrag found = foil_in_endless_flow(aspect_ratio, degrees * kDegree);
      const LiftAndDrag brix = by_brix(aspect_ratio, degrees * kDegree);
      EXPECT_NEAR(found.lift / brix.lift, 1, 0.09) << aspect_ratio << ", " << degrees;
      EXPECT_NEAR(found.drag, brix.drag, 0.05) << aspect_ratio << ", " << degrees;
    }
  EXPECT_NEAR(foil_in_endless_flow(1, 33.8 * kDegree).lift, 1.06, 0.06) << "NACA 0015, [Thieme1962], from memory";
  // Returns the normal force of [Fujii1960] with the aspect ratio of the blade below a hull.
  const Planar force =
      rudder_force({.area = 10, .wake_fraction = 0, .hull_factor = 0}, 0.05, {5, 0, 0}, 0, kSeaDensity);
  const double fujii = 0.5 * kSeaDensity * 10 * 25 * 6.13 * 1.5 / (1.5 + 2.25) * std::sin(0.05);
  EXPECT_NEAR(std::hypot(force.surge, force.sway) / fujii, 1, 0.1);
}

/// The table of docs/theory/ship.md.
TEST(RudderFoil, IsTheOneThatItsPageStates) {
  for (const auto& [aspect_ratio, degrees, lift, brix_lift, drag, brix_drag] :
       {std::tuple{1.0, 10, 0.27, 0.27, 0.03, 0.03},
        {1.0, 20, 0.57, 0.59, 0.12, 0.16},
        {1.5, 10, 0.36, 0.36, 0.03, 0.04},
        {1.5, 20, 0.74, 0.77, 0.13, 0.18},
        {2.25, 10, 0.47, 0.47, 0.03, 0.04},
        {2.25, 20, 0.95, 0.98, 0.14, 0.19},
        {3.0, 10, 0.55, 0.55, 0.04, 0.04},
        {3.0, 20, 1.10, 1.14, 0.14, 0.19}}) {
    constexpr double kHalfDigit = 0.0051;
    const LiftAndDrag found = foil_in_endless_flow(aspect_ratio, degrees * kDegree);
    const LiftAndDrag brix = by_brix(aspect_ratio, degrees * kDegree);
    EXPECT_NEAR(found.lift, lift, kHalfDigit);
    EXPECT_NEAR(found.drag, drag, kHalfDigit);
    EXPECT_NEAR(brix.lift, brix_lift, kHalfDigit);
    EXPECT_NEAR(brix.drag, brix_drag, kHalfDigit);
  }
}

TEST(RudderFoil, StallsWherePublishedRuddersDo) {
  for (const auto& [aspect_ratio, stall, most] : {std::tuple{1.0, 39.0, 1.2}, {2.0, 26.4, 1.2}, {3.0, 22.3, 1.2}}) {
    double largest = 0, at = 0;
    for (double degrees = 0; degrees <= 90; degrees += 0.1) {
      const double lift = foil_in_endless_flow(aspect_ratio, degrees * kDegree).lift;
      if (lift > largest) at = degrees;
      largest = std::max(largest, lift);
    }
    EXPECT_GE(at, stall - 0.1);
    EXPECT_LE(at, 1.25 * stall);
    EXPECT_NEAR(largest, most, 0.15);
    const LiftAndDrag across = foil_in_endless_flow(aspect_ratio, 90 * kDegree);
    EXPECT_NEAR(across.lift, 0, 1e-12);
    EXPECT_NEAR(across.drag, 1.17, 1e-12) << "a plate across the flow";
  }
}

TEST(RudderFoil, LosesLiftBeyondStall) {
  for (const double aspect_ratio : {0.5, 1.0, 1.5, 2.25, 4.0})
    for (double degrees = 62; degrees < 90; degrees += 1) {  // the latest stall is over at 60.6°
      const LiftAndDrag here = foil_in_endless_flow(aspect_ratio, degrees * kDegree);
      const LiftAndDrag next = foil_in_endless_flow(aspect_ratio, (degrees + 1) * kDegree);
      EXPECT_LT(next.lift, here.lift) << aspect_ratio << ", " << degrees;
      EXPECT_GT(next.drag, here.drag) << aspect_ratio << ", " << degrees;
    }
}

// ---- the race

/// The momentum theorem T = ρ A V (V − U) holds for an actuator disc and for an ideal duct.
TEST(Race, HasTheMomentumOfTheThrust) {
  for (const bool has_nozzle : {false, true})
    for (const double advance : {0.0, 0.5, 3.0, 8.0}) {
      const Race race = race_behind(11.95, has_nozzle, kThrust, advance, kSeaDensity);
      const double area = 0.25 * M_PI * race.diameter * race.diameter;
      EXPECT_NEAR(kSeaDensity * area * race.speed * (race.speed - advance), kThrust, 1e-6 * kThrust);
      EXPECT_LE(area, 11.95 * (1 + 1e-12));
    }
  EXPECT_NEAR(race_behind(11.95, false, 0, 5, kSeaDensity).speed, 5, 1e-12) << "no thrust, no race";
  EXPECT_LT(race_behind(11.95, false, 1e3, -5, kSeaDensity).speed, 0) << "a ship that goes astern outruns a weak race";
}

/// The race never leaves the blade with more momentum than it had, whatever the form and angle of the blade.
TEST(Race, IsTurnedAndLosesMomentumButNeverGainsAny) {
  for (const double aspect_ratio : {0.05, 0.2, 0.5, 0.94, 1.5, 3.0, 20.0})
    for (double degrees = -180; degrees <= 180; degrees += 0.5) {
      const LiftAndDrag over = foil_in_race(aspect_ratio, degrees * kDegree);
      ASSERT_LE(std::hypot(1 - over.drag, over.lift), 1 + 1e-12) << aspect_ratio << ", " << degrees;
      ASSERT_GE(over.drag, 0);
      ASSERT_LE(over.drag, 1 + 1e-12) << "a blade does not send the race back";
    }
}

/// A jet on an inclined plate much larger than itself presses it with the momentum across the plate. The shares along
/// and across the jet are sin² and sin cos of the angle.
TEST(Race, ImpingesOnALargePlateAsAJetDoes) {
  const LiftAndDrag over = foil_in_race(0.05, 80 * kDegree);
  EXPECT_NEAR(over.drag, std::pow(std::sin(80 * kDegree), 2), 0.02);
  EXPECT_NEAR(over.lift, std::sin(80 * kDegree) * std::cos(80 * kDegree), 0.02);
}

// ---- the rudder behind its propeller

TEST(Rudder, TurnsAShipToTheSideItIsLaidTo) {
  const Planar to_port = rudder_force(kRudder, 0.3, {6, 0, 0}, 0, kSeaDensity);
  EXPECT_LT(to_port.surge, 0);
  EXPECT_LT(to_port.sway, 0) << "the stern goes to starboard";
  EXPECT_GT(to_port.yaw, 0);
  const Planar to_starboard = rudder_force(kRudder, -0.3, {6, 0, 0}, 0, kSeaDensity);
  EXPECT_NEAR(to_starboard.yaw, -to_port.yaw, 1e-9 * to_port.yaw);
  EXPECT_LT(rudder_force(kRudder, 0.3, {-2, 0, 0}, 0, kSeaDensity).yaw, 0) << "astern it turns her the other way";
}

/// For a ship at rest the resultant of thrust and rudder force is at most the thrust, and never points astern.
TEST(Rudder, AtRestTurnsTheThrustAtMost) {
  for (const double aspect_ratio : {0.1, 0.5, 1.5, 4.0})
    for (const double area : {2.0, 12.96, 40.0, 144.0})
      for (const bool has_nozzle : {false, true})
        for (double degrees = -90; degrees <= 90; degrees += 1) {
          const Rudder rudder{.area = area,
                              .aspect_ratio = aspect_ratio,
                              .position = -60,
                              .propeller_area = 11.95,
                              .has_nozzle = has_nozzle};
          const Planar force = rudder_force(rudder, degrees * kDegree, {}, kThrust, kSeaDensity);
          ASSERT_LE(std::hypot(kThrust + force.surge, force.sway), kThrust * (1 + 1e-12)) << area << ", " << degrees;
          ASSERT_GE(kThrust + force.surge, -1e-6) << area << ", " << degrees;
        }
}

/// The reference ship's rudder at 35°: the race turns by e δ, with e = 3.6/(1.8 + √(Λ² + 4)), where Λ is the aspect
/// ratio of the blade in the race.
TEST(Rudder, AtRestTurnsTheRaceByAlmostItsAngle) {
  const double contracted = std::sqrt(4 / M_PI * 0.5 * 11.95), chord = std::sqrt(12.96 / 1.5);
  const double sine = 3.6 / (1.8 + std::hypot(contracted / chord, 2)) * std::sin(35 * kDegree);
  const Planar force = rudder_force(kRudder, 35 * kDegree, {}, kThrust, kSeaDensity);
  EXPECT_NEAR(force.sway / kThrust, -sine, 1e-9);
  EXPECT_NEAR(force.surge / kThrust, std::sqrt(1 - sine * sine) - 1, 1e-9);
  EXPECT_NEAR(sine, 0.515, 0.001);
}

/// The table of docs/theory/ship.md: forces ahead and aside as shares of the thrust, for the reference ship and for
/// Oden.
TEST(Rudder, AtRestHasTheForcesThatItsPageStates) {
  const Rudder oden{.area = 56, .count = 2, .propeller_area = 15.9, .thrust_share = 0.5, .has_nozzle = true};
  for (const auto& [degrees, ahead, aside, oden_ahead, oden_aside] : {std::tuple{10, -0.01, 0.16, -0.01, 0.15},
                                                                      {20, -0.05, 0.31, -0.05, 0.30},
                                                                      {35, -0.14, 0.52, -0.14, 0.51},
                                                                      {45, -0.30, 0.50, -0.33, 0.41},
                                                                      {70, -0.71, 0.26, -0.67, 0.24}}) {
    constexpr double kHalfDigit = 0.0051;
    const Planar force = rudder_force(kRudder, degrees * kDegree, {}, kThrust, kSeaDensity);
    EXPECT_NEAR(force.surge / kThrust, ahead, kHalfDigit) << degrees;
    EXPECT_NEAR(-force.sway / kThrust, aside, kHalfDigit) << degrees;
    const Planar of_oden = rudder_force(oden, degrees * kDegree, {}, kThrust, kSeaDensity);
    EXPECT_NEAR(of_oden.surge / kThrust, oden_ahead, kHalfDigit) << degrees;
    EXPECT_NEAR(-of_oden.sway / kThrust, oden_aside, kHalfDigit) << degrees;
  }
}

TEST(Rudder, OnlyTheShareOfABladeInTheRaceBearsAtRest) {
  Rudder tall = kRudder;  // twice as high, of the same chord
  tall.area *= 2;
  tall.aspect_ratio *= 2;
  EXPECT_NEAR(rudder_force(tall, 0.4, {}, kThrust, kSeaDensity).sway,
              rudder_force(kRudder, 0.4, {}, kThrust, kSeaDensity).sway, 1e-6);
  EXPECT_GT(size(rudder_force(tall, 0.4, {5, 0, 0}, 0, kSeaDensity)),
            1.9 * size(rudder_force(kRudder, 0.4, {5, 0, 0}, 0, kSeaDensity)));
  EXPECT_EQ(size(rudder_force(without_race(), 0.4, {}, kThrust, kSeaDensity)), 0);
}

TEST(Rudder, TwinRuddersShareThrustAndArea) {
  Rudder twin = kRudder;
  twin.area *= 2;
  twin.count = 2;
  twin.thrust_share = 0.5;
  const Planar both = rudder_force(twin, 0.4, {3, 0.2, 0.01}, 2 * kThrust, kSeaDensity);
  const Planar one = rudder_force(kRudder, 0.4, {3, 0.2, 0.01}, kThrust, kSeaDensity);
  EXPECT_NEAR(both.surge, 2 * one.surge, 1e-6);
  EXPECT_NEAR(both.sway, 2 * one.sway, 1e-6);
}

/// A race as slow as the water around it has no effect.
TEST(Rudder, BehindAPropellerWithoutThrustIsAFoilInTheHullsFlow) {
  for (const Planar& motion : {Planar{6, 0, 0}, {2, 0.5, 0.02}, {-3, 0.1, 0.01}}) {
    const Planar expected = rudder_force(without_race(), 0.3, motion, 0, kSeaDensity);
    for (const double thrust : {-kThrust, 0.0, 1.0}) {
      const Planar found = rudder_force(kRudder, 0.3, motion, thrust, kSeaDensity);
      EXPECT_NEAR(found.surge, expected.surge, 1e-3 * size(expected));
      EXPECT_NEAR(found.sway, expected.sway, 1e-3 * size(expected));
    }
  }
}

/// The force is continuous where the ship stops, and where a race becomes too weak to reach the rudder.
TEST(Rudder, HasNoJumps) {
  constexpr double kSmall = 1e-7;
  for (const double thrust : {-1e5, 0.0, 5e4, kThrust})
    for (const double speed : {-6.0, -2.0458, 0.0, 0.3, 5.0})
      for (const double across : {-1.0, 0.0, 0.4})
        for (double degrees = -90; degrees <= 90; degrees += 5) {
          const auto at = [&](double u, double t) {
            return rudder_force(kRudder, degrees * kDegree, {u, across, 0}, t, kSeaDensity);
          };
          const Planar here = at(speed, thrust);
          ASSERT_LT(size(at(speed + kSmall, thrust) - here), 1e3) << thrust << ", " << speed << ", " << degrees;
          ASSERT_LT(size(at(speed - kSmall, thrust) - here), 1e3) << thrust << ", " << speed << ", " << degrees;
          ASSERT_LT(size(at(speed, thrust + 1e-3) - here), 1e3) << thrust << ", " << speed << ", " << degrees;
        }
}

TEST(Rudder, AmidshipsItDampsTheTurn) {
  const Planar turning{4, 0.1, 0.02};
  EXPECT_LT(dot(turning, rudder_force(kRudder, 0, turning, 3e5, kSeaDensity)), 0);
  EXPECT_LT(rudder_force(kRudder, 0, {4, 0, 0.02}, 3e5, kSeaDensity).yaw, 0);
}

}  // namespace
}  // namespace polynya::dynamics
