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

TEST(CrushedReceding, OfAWedgeIsTheRootOfAQuadratic) {
  // A_c = a ξ²: ξ + r a ξ² = d.
  const double angle = 0.9;
  const Overlap overlap{1.2, 0.3, 0.5 * 1.2 * 0.3};
  const double a = 0.5 * (1.2 / 0.3) / std::sin(angle);
  for (const double recession : {0.01, 1.0, 30.0}) {
    const RecedingCrush found = crushed_receding(overlap, 0.3, 5, angle, recession);
    const double root = (std::sqrt(1 + 4 * recession * a * 0.3) - 1) / (2 * recession * a);
    EXPECT_NEAR(found.penetration / root, 1, 1e-9) << recession;
    EXPECT_NEAR(found.crushed.area / (a * root * root), 1, 1e-9);
    EXPECT_NEAR(found.crushed.slope / (2 * a * root / (1 + 2 * recession * a * root)), 1, 1e-9);
  }
}

TEST(CrushedReceding, DividesTheDepthAlsoWhereTheFacetSpansTheThickness) {
  for (const double power : {1.0, 1.5, 2.0, 3.0}) {
    const Overlap overlap{2, 0.4, 2 * 0.4 / power};
    for (const double angle : {0.2, 0.5, 1.0}) {
      for (const double recession : {0.003, 0.2, 5.0}) {
        const auto at = [&](double depth) { return crushed_receding(overlap, depth, 0.5, angle, recession); };
        const RecedingCrush found = at(0.45);
        EXPECT_NEAR(found.penetration + recession * found.crushed.area, 0.45, 1e-11);
        EXPECT_LT(found.penetration, 0.45);
        EXPECT_LE(found.crushed.area, crushed_overlap_at(overlap, 0.45, 0.5, angle).area * (1 + 1e-12));
        const double step = 1e-5;
        const double slope = (at(0.45 + step).crushed.area - at(0.45 - step).crushed.area) / (2 * step);
        EXPECT_NEAR(found.crushed.slope, slope, 1e-4 * slope + 1e-9);
      }
    }
  }
}

TEST(CrushedReceding, WithoutRecessionIsThePlainOverlap) {
  const Overlap overlap{2, 0.4, 0.4};
  const RecedingCrush found = crushed_receding(overlap, 0.5, 0.5, 0.6, 0);
  const CrushedArea plain = crushed_overlap_at(overlap, 0.5, 0.5, 0.6);
  EXPECT_EQ(found.penetration, 0.5);
  EXPECT_EQ(found.crushed.area, plain.area);
  EXPECT_EQ(found.crushed.slope, plain.slope);
}

TEST(CrushedOverlapArea, OfNothingIsNothing) {
  EXPECT_EQ(crushed_overlap_area({0, 0, 0}, 0.5, 0.5), 0);
  EXPECT_EQ(crushed_overlap_area({1, 0, 0}, 0.5, 0), 0);
  EXPECT_EQ(crushed_overlap_area({1, 0.1, 0}, 0.5, 0), 0);
}

}  // namespace
}  // namespace polynya::fracture
