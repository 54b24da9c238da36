#include "dynamics/contact/paid_overlap.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "dynamics/contact/crush_law.hpp"

namespace polynya::dynamics {
namespace {

/// Returns the contact of a wedge, whose exponent p is 2.
Contact wedge(double depth, double opening) {
  Contact c;
  c.depth = depth;
  c.width = opening * depth;
  c.area = 0.5 * c.width * depth;
  return c;
}

TEST(PaidOverlap, AreaAndDepthOfAWedgeAreEachOthers) {
  const Contact c = wedge(0.4, 1.5);
  for (const double depth : {0.01, 0.2, 0.4, 0.9}) {
    EXPECT_NEAR(area_at(c, depth), 0.75 * depth * depth, 1e-12);
    EXPECT_NEAR(depth_at(c, area_at(c, depth)), depth, 1e-12);
  }
  EXPECT_EQ(depth_at(c, 0), 0);
}

/// A band of 2 cm along two flanks of a body that lie 1 m across and reach 0.5 m back: ξ w is 26 times S.
TEST(PaidOverlap, ACrescentGrowsByItsWidth) {
  Contact c;
  c.width = 1;
  c.depth = 0.52;
  c.area = 0.02;
  ASSERT_TRUE(is_crescent(c));
  EXPECT_NEAR(area_at(c, 0.53), 0.03, 1e-15);
  EXPECT_NEAR(area_at(c, 0.51), 0.01, 1e-15);
  EXPECT_EQ(area_at(c, 0.4), 0);
  for (const double area : {0.001, 0.02, 0.5}) EXPECT_NEAR(area_at(c, depth_at(c, area)), area, 1e-15);
  EXPECT_EQ(depth_at(c, 0), 0);
  EXPECT_FALSE(is_crescent(wedge(0.4, 1.5)));
}

/// For F = a ξ^n the work between two depths has a closed form.
TEST(PaidOverlap, WorkPaysAsFarAsItsIntegralReaches) {
  for (const double n : {0.0, 0.5, 1.0, 2.0}) {
    const auto force = [&](double depth) { return 3e5 * std::pow(depth, n); };
    const auto work = [&](double from, double to) {
      return 3e5 / (n + 1) * (std::pow(to, n + 1) - std::pow(from, n + 1));
    };
    const CrushingForce law{force(0.3), n, 0.3};
    for (const double to : {0.21, 0.3, 0.35}) {
      const Payment payment = pay(law, 0.2, 0.4, work(0.2, to));
      EXPECT_NEAR(payment.depth, to, 1e-12) << n;
      EXPECT_NEAR(payment.work, work(0.2, to), 1e-6);
    }
    const Payment all = pay(law, 0.2, 0.4, 2 * work(0.2, 0.4));
    EXPECT_EQ(all.depth, 0.4);
    EXPECT_NEAR(all.work, work(0.2, 0.4), 1e-6) << "what is left has crushed nothing";
    EXPECT_EQ(pay(law, 0.2, 0.4, -1).depth, 0.2) << "work that is given back pays nothing, and takes nothing back";
  }
}

TEST(PaidOverlap, ForceGrowsInAStepByItsMeanStiffnessWhereItIsConcave) {
  const CrushingForce concave{2e5, 0.2, 0.001};
  EXPECT_NEAR(stiffness_over(concave, 0), 0.2 * 2e5 / 0.001, 1e-3) << "the tangent";
  EXPECT_NEAR(2e5 + 0.009 * stiffness_over(concave, 0.009), force_at(concave, 0.01), 1e-6);
  EXPECT_NEAR(force_at(concave, 0.01), 2e5 * std::pow(10, 0.2), 1e-6);
  const CrushingForce wedge{2e5, 1, 0.001};
  EXPECT_NEAR(stiffness_over(wedge, 0.009), 2e8, 1e-3);
  EXPECT_EQ(stiffness_over({2e5, 0, 0.001}, 0.009), 0);
}

TEST(PaidOverlap, WhatBreaksOrTiltsIsPaidButNotByWork) {
  for (const bool is_broken : {true, false}) {
    PersistentContact record;
    Contact c = wedge(0.4, 1.5);
    c.record = &record;
    c.crushing_force = 1e5;
    c.depth_after = 0.5;
    c.is_broken = is_broken;
    c.gives_way = !is_broken;
    settle(false, c);
    EXPECT_NEAR(record.paid_area, area_at(c, 0.5), 1e-12);
    EXPECT_EQ(c.paid_by_work, 0);
    EXPECT_NEAR(c.paid_by_giving_way, area_at(c, 0.5), 1e-12);
  }
}

/// A floe that tilts takes a fraction of the force that would crush it. It yields to that force as fast as ice would
/// yield to the whole force.
TEST(PaidOverlap, OfIceLetInByAFractionOfTheCrushingForceThatFractionIsCrushed) {
  PersistentContact record;
  Contact c = wedge(0.4, 1.5);
  c.record = &record;
  c.crushing_force = 1e5;
  c.crushing_share = 0.1;
  c.gives_way = true;
  c.depth_after = c.paid_depth_after = 0.5;
  settle(false, c);
  EXPECT_NEAR(record.paid_area, area_at(c, 0.5), 1e-12);
  EXPECT_NEAR(c.paid_by_work, 0.1 * area_at(c, 0.5), 1e-12);
  EXPECT_NEAR(c.paid_by_giving_way, 0.9 * area_at(c, 0.5), 1e-12);
}

TEST(PaidOverlap, WhatIsNotPaidPressesBodiesAtRest) {
  CrushResponse law{.impulse_of_force = 100, .slope = 0, .gap_speed = -0.02, .cap = 1e9};
  law.creep_speed = creep_speed_of(law.gap_speed);
  EXPECT_GT(crush_impulse(law, 0), 0.5 * law.impulse_of_force);
  EXPECT_LT(crush_impulse(law, 0), law.impulse_of_force);
  EXPECT_EQ(crush_impulse(law, kCreepSpeed), law.impulse_of_force) << "as if all were paid";
  EXPECT_EQ(crush_impulse(law, -0.02), 0) << "they part as fast as it is to be undone";
}

}  // namespace
}  // namespace polynya::dynamics
