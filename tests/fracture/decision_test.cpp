// docs/theory/decision.md as a truth table; and the lengths and loads that decide, by hand.
#include "fracture/decision.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "fracture/characteristic_length.hpp"
#include "fracture/tilting.hpp"

namespace polynya::fracture {
namespace {

struct Case {
  bool is_large, has_crack, is_hit_hard, is_pressed_down, is_over_capacity;
};

FailureCriteria criteria_of(const Case& c) {
  FailureCriteria criteria;
  criteria.breakable_size = 10;
  criteria.floe_size = c.is_large ? 10 : 9.999;
  criteria.crack_length = c.has_crack ? 5 : 0;
  criteria.splitting_force = 1e6;
  criteria.collision_force = c.is_hit_hard ? 1.001e6 : 1e6;
  criteria.vertical_force = c.is_pressed_down ? 5e4 : -5e4;
  criteria.bending_capacity = c.is_over_capacity ? -1e5 : 1e5;
  if (c.is_pressed_down && c.is_over_capacity) criteria.bending_capacity = 5e4;
  return criteria;
}

TEST(Decision, FollowsItsTruthTable) {
  for (int bits = 0; bits < 32; ++bits) {
    const Case c{(bits & 1) != 0, (bits & 2) != 0, (bits & 4) != 0, (bits & 8) != 0, (bits & 16) != 0};
    Failure expected = Failure::kCrush;
    if (c.is_pressed_down && c.is_over_capacity) expected = Failure::kBend;
    if (c.has_crack && c.is_hit_hard) expected = Failure::kSplit;  // a split comes before a bend
    if (!c.is_large) expected = Failure::kNone;                    // and a small floe never breaks
    EXPECT_EQ(decide(criteria_of(c)), expected) << "case " << bits;
  }
}

TEST(Decision, IsOnItsEdgesAsTheTheorySays) {
  FailureCriteria cracked = criteria_of({true, true, true, false, false});
  EXPECT_LT(cracked.crack_length, cracked.breakable_size);
  EXPECT_EQ(decide(cracked), Failure::kSplit) << "a crack shorter than the breakable size";
  cracked.leaves_sliver = true;
  EXPECT_EQ(decide(cracked), Failure::kCrush);
  FailureCriteria pressed = criteria_of({true, true, false, true, true});
  EXPECT_EQ(pressed.collision_force, pressed.splitting_force);
  EXPECT_EQ(pressed.vertical_force, pressed.bending_capacity);
  EXPECT_EQ(decide(pressed), Failure::kBend);
  pressed.vertical_force = 4.999e4;
  EXPECT_EQ(decide(pressed), Failure::kCrush);
  pressed.vertical_force = pressed.bending_capacity = 0;
  EXPECT_EQ(decide(pressed), Failure::kCrush) << "not pressed down it never bends, however weak";
}

// ---- the plate's length scale

TEST(CharacteristicLength, IsTheFourthRootOfRigidityOverFoundationAndAsPrintedItsSquare) {
  const Water water;
  for (const Ice& ice : {Ice{}, Ice{.thickness = 8}, Ice{.youngs_modulus = 5e10}})
    EXPECT_NEAR(flexural_rigidity(ice) / (water.density * kGravity * std::pow(characteristic_length(ice, water), 4)), 1,
                1e-14);
  EXPECT_NEAR(breakable_length(Ice{}, {}, CharacteristicLength::kFourthRoot), 8.909, 5e-4);
  EXPECT_NEAR(breakable_length(Ice{}, {}, CharacteristicLength::kAsPrinted), 79.4, 0.05);
}

// ---- a floe whose edge an inclined hull presses down

constexpr double kArea = 225;  // area of a floe of 15 m

const TiltResistance kResistance = tilt_resistance({.thickness = 0.5}, {}, kArea, 1);

TEST(Tilting, TheResistanceOfTheReferenceFloeIsAsDerivedByHand) {
  EXPECT_NEAR(kResistance.capacity / (1000 * 9.81 * 0.5 * kArea), 0.0487, 5e-5);
  EXPECT_NEAR(kResistance.mass, 227e3, 1e3);
  EXPECT_NEAR(0.5 * std::numbers::pi / std::sqrt(kResistance.stiffness / kResistance.mass), 1.0, 0.02)
      << "a quarter period of 1 s";
}

TEST(Tilting, AStaticLoadPressesTheEdgeDownByItsShareOfTheStiffnessOrAboveTheCapacityWithoutEnd) {
  const double load = 0.5 * kResistance.capacity;
  EdgeMotion edge;
  const auto press = [&](double by, double seconds) {
    for (int i = 0; i < seconds / 0.005; ++i) edge = tilted(kResistance, edge, by, 0.3, 0.005);
  };
  press(load, 200);
  EXPECT_NEAR(edge.deflection, load / kResistance.stiffness, 1e-9);
  EXPECT_NEAR(edge.rate, 0, 1e-9);
  press(0, 200);
  EXPECT_NEAR(edge.deflection, 0, 1e-9) << "and without it the floe floats as before";
  press(1.1 * kResistance.capacity, 20);
  EXPECT_GT(edge.deflection, 0.9 * 0.5);
}

TEST(Tilting, WithoutDampingItSwingsAsAnOscillatorDoes) {
  const double frequency = std::sqrt(kResistance.stiffness / kResistance.mass);
  const double load = 0.2 * kResistance.capacity;
  const double dt = 1e-4;
  EdgeMotion edge;
  for (int i = 1; i <= 10000; ++i) {
    edge = tilted(kResistance, edge, load, 0, dt);
    const double expected = load / kResistance.stiffness * (1 - std::cos(frequency * i * dt));
    ASSERT_NEAR(edge.deflection, expected, 1e-3 * load / kResistance.stiffness) << i * dt;
  }
}

TEST(Tilting, TheMostAContactTransmitsMakesTheEdgeAsFastAsTheHullSlidesIt) {
  const EdgeMotion edge{0.1, 0.05};
  const double most = most_vertical_force(kResistance, edge, 0.4, 0.005);
  EXPECT_NEAR(tilted(kResistance, edge, most, 0, 0.005).rate, 0.4, 1e-12);
  EXPECT_EQ(most_vertical_force(kResistance, {0.1, 0.5}, 0.4, 0.005), kResistance.at(0.1))
      << "an edge that is faster than the hull presses it down is held by its weight alone";
}

}  // namespace
}  // namespace polynya::fracture
