// Crushing, Eqs. (1)–(3) of [Sawamura2017], against the printed branches, their limits and the laws of
// friction.
#include "fracture/crushing.hpp"

#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "tests/fracture/wedge_contact.hpp"
#include "tests/shapes.hpp"

namespace polynya::fracture {
namespace {

using shapes::kDegree;

/// The two branches as the paper prints them, which meet without a jump of value or slope: there more closely.
TEST(CrushedArea, IsThePrintedEquation) {
  for (const double degrees : {0.1, 1.0, 11.3, 38.2, 60.0, 85.0}) {
    for (const double thickness : {0.1, 0.5, 2.0}) {
      const double angle = degrees * kDegree, reach = thickness * std::tan(angle);
      const auto expect_printed = [&](double depth, double tolerance) {
        const double beyond = std::max(depth - reach, 0.0);
        const double printed = 2.5 / (2 * std::sin(angle)) * (depth * depth - beyond * beyond);
        EXPECT_NEAR(crushed_area(2.5, depth, thickness, angle) / printed, 1, tolerance)
            << "hull " << degrees << " deg, h " << thickness << " m, depth " << depth << " m";
      };
      for (double depth = 0.01; depth < 20; depth *= 1.7) expect_printed(depth, 1e-9);
      for (const double width : {-1e-3, -1e-5, -1e-15, 0.0, 1e-15, 1e-5, 1e-3})
        expect_printed(reach * (1 + width), 1e-13);
    }
  }
}

TEST(CrushedArea, DividesByNoZeroAndGrowsWithDepth) {
  for (const double angle : {0.0, std::numeric_limits<double>::denorm_min(), 1e-300, 1e-12, 0.3, 1.5}) {
    double last = 0;
    for (double depth = 1e-12; depth < 100; depth *= 3) {
      const double area = crushed_area(2, depth, 0.5, angle);
      ASSERT_TRUE(std::isfinite(area)) << angle << ' ' << depth;
      ASSERT_GT(area, last) << angle << ' ' << depth;
      last = area;
    }
    EXPECT_EQ(crushed_area(2, 0, 0.5, angle), 0);
    EXPECT_EQ(crushed_area(2, -1, 0.5, angle), 0);
  }
}

TEST(HullAngle, OfThePapersShip) {
  const double stem = 30 * kDegree;
  EXPECT_NEAR(hull_angle_from_vertical(std::sin(27 * kDegree), stem) / kDegree, 38.2, 0.05);  // bow flank
  EXPECT_NEAR(hull_angle_from_vertical(1, stem) / kDegree, 60, 1e-10);                        // stem
  EXPECT_EQ(hull_angle_from_vertical(0, stem), 0);                                            // parallel midbody
  EXPECT_EQ(hull_angle_from_vertical(-1, stem), 0);                                           // stern: a wall
}

TEST(CrushingShares, OnlyAHullLessSteepThanFrictionPressesTheIceDown) {
  for (const double friction : {0.0, 0.05, 0.2, 0.6}) {
    for (double degrees = 0; degrees < 90; degrees += 0.25) {
      const double angle = degrees * kDegree;
      const double over = angle - std::atan(friction);
      if (std::abs(over) < 1e-9) continue;  // the edge itself, where rounding decides
      EXPECT_EQ(crushing_shares(angle, friction, 1, 0).vertical > 0, over > 0) << friction << ' ' << degrees;
    }
  }
  EXPECT_NEAR(std::atan(0.2) / kDegree, 11.3, 0.05);
}

TEST(CrushingShares, FrictionIsSharedBetweenDownAndAlongTheHull) {
  // V is smaller than the frictionless sin θ_s by μ s cos θ_s; the rest of the slip is along the hull. At pure normal
  // approach the force has μ down the facet and 1 along its normal, √(1 + μ²) in all.
  const double friction = 0.2;
  for (const double degrees : {1.0, 5.0, 38.2, 60.0}) {
    const double angle = degrees * kDegree;
    for (const double slip : {0.0, 0.1, 1.0, 30.0}) {
      const CrushingShares shares = crushing_shares(angle, friction, 0.5, slip);
      const double down = (std::sin(angle) - shares.vertical) / std::cos(angle);
      EXPECT_NEAR(std::hypot(down, shares.tangential), friction, 1e-14);
      EXPECT_NEAR(down * slip, shares.tangential * 0.5 * std::sin(angle), 1e-14) << "along the slip, as friction acts";
      if (slip > 0) continue;
      EXPECT_NEAR(std::hypot(shares.horizontal, shares.vertical), std::hypot(1, friction), 1e-14);
      EXPECT_EQ(shares.tangential, 0);
    }
  }
}

TEST(CrushingShares, PowerIsNeverFedIn) {
  // Work of the hull on the ice: H v_n plus the friction along the hull times the slip there. It is never negative.
  // Friction does not exceed μ F_n along the hull and does not act against the slip.
  for (double degrees = 0; degrees < 90; degrees += 3) {
    for (const double friction : {0.0, 0.2, 0.9}) {
      for (const double approach : {0.0, 1e-9, 0.3, 5.0}) {
        for (const double slip : {-8.0, -0.1, 0.0, 0.2, 40.0}) {
          const CrushingShares shares = crushing_shares(degrees * kDegree, friction, approach, slip);
          EXPECT_GT(shares.horizontal, 0);
          EXPECT_GE(shares.tangential, 0);
          EXPECT_LE(shares.tangential, friction);
          EXPECT_LE(shares.vertical, std::sin(degrees * kDegree));
          EXPECT_GE(shares.horizontal * approach + shares.tangential * std::abs(slip), 0);
          EXPECT_EQ(shares.vertical, crushing_shares(degrees * kDegree, friction, approach, -slip).vertical);
        }
      }
    }
  }
}

TEST(CrushingShares, AVerticalWallTakesAllFrictionAlongItself) {
  const CrushingShares shares = crushing_shares(0, 0.2, 1, 0);
  EXPECT_EQ(shares.horizontal, 1);
  EXPECT_LE(shares.vertical, 0);
  EXPECT_EQ(shares.tangential, 0.2);
}

// ---- contacts that bend around a stem

/// A stem of two flanks at an angle from the centreline, whose waterlines are `port` and `starboard` long, in the frame
/// of a contact with its normal ahead.
std::vector<HullFacet> stem(double waterline_angle, double stem_angle, double port, double starboard) {
  const double sine = std::sin(waterline_angle), cosine = std::cos(waterline_angle);
  const double angle = hull_angle_from_vertical(sine, stem_angle);
  return {{starboard, {sine, -cosine}, angle}, {port, {sine, cosine}, angle}};
}

TEST(CrushingShares, OfOneFacetAreThoseOfItsContact) {
  for (const double angle : {0.05, 0.6, 1.3}) {
    for (const double slip : {-2.0, 0.0, 0.3}) {
      const HullFacet facet{2, {1, 0}, angle};
      const CrushingShares of_facet = crushing_shares_around({&facet, 1}, angle, 0.2, {0.7, slip});
      const CrushingShares of_contact = crushing_shares(angle, 0.2, 0.7, slip);
      EXPECT_EQ(of_facet.horizontal, of_contact.horizontal);
      EXPECT_NEAR(of_facet.vertical, of_contact.vertical, 1e-14);
      EXPECT_NEAR(of_facet.tangential, of_contact.tangential, 1e-14);
    }
  }
}

/// V of both flanks, each crushed over its half of the overlap S by its own shares, is V of the stem: S/sin θ is the
/// area of a facet of the plan area S.
TEST(CrushingShares, OfAStemAreThoseOfItsTwoFlanks) {
  const double friction = 0.2;
  for (const double waterline : {10 * kDegree, 27 * kDegree, 70 * kDegree}) {
    for (const double stem_angle : {20 * kDegree, 60 * kDegree, 85 * kDegree, 89.5 * kDegree}) {
      const double flank = hull_angle_from_vertical(std::sin(waterline), stem_angle);
      const CrushingShares of_flank = crushing_shares(flank, friction, std::sin(waterline), std::cos(waterline));
      const double at_stem = hull_angle_from_vertical(1, stem_angle);
      const auto facets = stem(waterline, stem_angle, 3, 3);
      const CrushingShares shares = crushing_shares_around(facets, at_stem, friction, {1, 0});
      EXPECT_NEAR(shares.vertical / std::sin(at_stem) / (of_flank.vertical / std::sin(flank)), 1, 1e-12);
      EXPECT_NEAR(shares.tangential, 0, 1e-14) << "the flanks' friction along the line cancels";
    }
  }
}

/// Ice slides down along a flank that it meets at more than the angle of friction from its normal, however steep the
/// flank is. The flanks of a stem therefore press it down up to 90°. Head on, a facet steeper than 90° - atan μ holds
/// it up.
TEST(CrushingShares, AStemPressesDownWhereItsFlanksDo) {
  const double friction = 0.2;
  const double widest = std::atan(1 / friction);  // of a vertical flank from the centreline, at which ice sticks
  for (double degrees = 5; degrees < 90; degrees += 1) {
    const double waterline = degrees * kDegree;
    if (std::abs(waterline - widest) < 0.5 * kDegree) continue;
    const double stem_angle = 89.9 * kDegree;
    const auto facets = stem(waterline, stem_angle, 1, 1);
    const double at_stem = hull_angle_from_vertical(1, stem_angle);
    EXPECT_EQ(crushing_shares_around(facets, at_stem, friction, {1, 0}).vertical > 0, waterline < widest) << degrees;
  }
}

TEST(CrushingShares, AFacetThatTheHullDrawsAwayFromTakesNoPart) {
  const double at_stem = hull_angle_from_vertical(1, 40 * kDegree);
  std::vector<HullFacet> facets = stem(27 * kDegree, 40 * kDegree, 2, 3);
  const CrushingShares before = crushing_shares_around(facets, at_stem, 0.2, {1, 0.1});
  facets.push_back({5, {0, 1}, 0});
  facets.push_back({5, {-1, 0}, 0});
  const CrushingShares after = crushing_shares_around(facets, at_stem, 0.2, {1, -0.0});
  facets.resize(2);
  EXPECT_EQ(after.vertical, crushing_shares_around(facets, at_stem, 0.2, {1, -0.0}).vertical);
  EXPECT_LT(before.vertical, std::sin(at_stem));
}

// ---- overlaps other than wedges, against closed forms

TEST(CrushedOverlapArea, OfAStraightEdgeIsItsFlatForm) {
  // If S = w ξ, A_c = w [ξ − ⟨ξ − h tan θ⟩] / sin θ, which is the area of the facet once it spans the thickness.
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
  // The limit h dS/dξ is reached without a jump: the distance to it shrinks in proportion to the angle, down to
  // rounding.
  for (const double power : {1.0, 1.5, 2.0, 3.0}) {
    const double depth = 0.2;
    const Overlap overlap{3, depth, 3 * depth / power};  // S = c ξ^p: dS/dξ = p S / ξ
    const double wall = 0.5 * 3;
    EXPECT_NEAR(crushed_overlap_area(overlap, 0.5, 0), wall, 1e-15);
    for (double angle = 0.03; angle > 1e-14; angle /= 3) {
      EXPECT_NEAR(crushed_overlap_area(overlap, 0.5, angle) / wall, 1, 3 * angle * 0.5 / depth + 1e-9) << angle;
    }
  }
}

TEST(CrushedOverlapArea, IsContinuousInAngleDepthAndShape) {
  for (double angle = 0; angle < 1.5; angle += 1e-3) {
    for (const double power : {1.0, 1.7, 2.0}) {
      for (const double depth : {0.01, 0.3, 2.0}) {
        const auto area = [&](double d, double a) { return crushed_overlap_area({2, d, 2 * d / power}, 0.5, a); };
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
  EXPECT_EQ(std::pair(found.crushed.area, found.crushed.slope), std::pair(plain.area, plain.slope));
}

/// Integrates dV/dξ = A_c cos θ_s up to the overlap by the midpoint rule.
TEST(CrushedVolume, IsWhatTheFacetPassesOver) {
  constexpr double kIceThickness = 0.7;
  constexpr int kSteps = 4000;
  for (const double power : {1.0, 1.6, 2.0, 3.0}) {
    const Overlap overlap{power * 0.9 / 1.3, 1.3, 0.9};
    for (const double angle : {0.0, 0.3, 0.8, 1.2}) {
      double volume = 0;
      for (int i = 0; i < kSteps; ++i) {
        const double depth = overlap.depth * (i + 0.5) / kSteps;
        volume +=
            crushed_overlap_at(overlap, depth, kIceThickness, angle).area * std::cos(angle) * overlap.depth / kSteps;
      }
      EXPECT_NEAR(crushed_volume(overlap, overlap.area, kIceThickness, angle) / volume, 1, 1e-4)
          << power << ' ' << angle;
    }
  }
  EXPECT_EQ(crushed_volume({1, 1, 1}, 0, kIceThickness, 0.3), 0);
}

TEST(CrushedOverlapArea, OfNothingIsNothing) {
  EXPECT_EQ(crushed_overlap_area({0, 0, 0}, 0.5, 0.5), 0);
  EXPECT_EQ(crushed_overlap_area({1, 0, 0}, 0.5, 0), 0);
  EXPECT_EQ(crushed_overlap_area({1, 0.1, 0}, 0.5, 0), 0);
}

}  // namespace
}  // namespace polynya::fracture
