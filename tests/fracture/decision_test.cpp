// Section 8 of docs/theory.md as a truth table.
#include "fracture/decision.hpp"

#include <gtest/gtest.h>

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

TEST(Decision, ACrackThatParesDoesNotCountAndOneShorterThanTheBreakableSizeDoes) {
  FailureCriteria criteria = criteria_of({true, true, true, false, false});
  ASSERT_LT(criteria.crack_length, criteria.breakable_size);
  EXPECT_EQ(decide(criteria), Failure::kSplit);
  criteria.pares = true;
  EXPECT_EQ(decide(criteria), Failure::kCrush);
}

TEST(Decision, AForceThatEqualsTheSplittingForceDoesNotSplitButOneThatEqualsTheCapacityBends) {
  FailureCriteria criteria = criteria_of({true, true, false, true, true});
  EXPECT_EQ(decide(criteria), Failure::kBend);
  criteria.vertical_force = 4.999e4;
  EXPECT_EQ(decide(criteria), Failure::kCrush);
}

TEST(Decision, IceThatIsNotPressedDownNeverBendsHoweverWeak) {
  FailureCriteria criteria = criteria_of({true, false, false, false, false});
  criteria.vertical_force = 0;
  criteria.bending_capacity = 0;
  EXPECT_EQ(decide(criteria), Failure::kCrush);
}

}  // namespace
}  // namespace polynya::fracture
