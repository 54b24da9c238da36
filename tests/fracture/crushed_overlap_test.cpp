// The crushed area of overlaps other than wedges (crushing_test.cpp), against closed forms.
#include <cmath>

#include <gtest/gtest.h>

#include "fracture/crushing.hpp"

namespace polynya::fracture {
namespace {

TEST(CrushedOverlapArea, OfAStraightEdgeIsItsFlatForm) {
  // S = w ξ: A_c = w [ξ − ⟨ξ − h tan θ⟩] / sin θ, the facet's own area once it spans the thickness.
  for (const double angle : {0.01, 0.67, 1.2}) {
    for (double depth = 1e-4; depth < 30; depth *= 2.3) {
      const double reach = 0.5 * std::tan(angle);
      const double expected = 4 * std::min(depth, reach) / std::sin(angle);
      EXPECT_NEAR(crushed_overlap_area({4, depth, 4 * depth}, 0.5, angle) / expected, 1, 1e-9);
      if (depth > reach) {
        EXPECT_NEAR(expected, 4 * 0.5 / std::cos(angle), 1e-9);
      }
    }
  }
}

TEST(CrushedOverlapArea, TendsToThicknessTimesContactLineAtAVerticalWall) {
  // h dS/dξ, reached without a jump: the distance to it shrinks in proportion to the angle, down to rounding.
  for (const double power : {1.0, 1.5, 2.0, 3.0}) {
    const double depth = 0.2;
    const Overlap overlap{3, depth, 3 * depth / power};  // S = c ξ^p: dS/dξ = p S / ξ
    const double wall = 0.5 * 3;
    EXPECT_NEAR(crushed_overlap_area(overlap, 0.5, 0), wall, 1e-15);
    for (double angle = 0.03; angle > 1e-14; angle /= 3) {
      EXPECT_NEAR(crushed_overlap_area(overlap, 0.5, angle) / wall, 1, 3 * angle * 0.5 / depth + 1e-9)
          << angle;
    }
  }
}

TEST(CrushedOverlapArea, IsContinuousInAngleDepthAndShape) {
  for (double angle = 0; angle < 1.5; angle += 1e-3) {
    for (const double power : {1.0, 1.7, 2.0}) {
      for (const double depth : {0.01, 0.3, 2.0}) {
        const auto area = [&](double d, double a) {
          return crushed_overlap_area({2, d, 2 * d / power}, 0.5, a);
        };
        const double here = area(depth, angle);
        EXPECT_NEAR(area(depth, angle + 1e-9) / here, 1, 1e-4);
        EXPECT_NEAR(area(depth * (1 + 1e-9), angle) / here, 1, 1e-4);
      }
    }
  }
}

TEST(CrushedOverlapArea, OfNothingIsNothing) {
  EXPECT_EQ(crushed_overlap_area({0, 0, 0}, 0.5, 0.5), 0);
  EXPECT_EQ(crushed_overlap_area({1, 0, 0}, 0.5, 0), 0);
  EXPECT_EQ(crushed_overlap_area({1, 0.1, 0}, 0.5, 0), 0);
}

}  // namespace
}  // namespace polynya::fracture
