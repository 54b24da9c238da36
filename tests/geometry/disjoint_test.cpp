// Polygons that overlap: found, made disjoint; and simplified.
#include <cmath>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/outline.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using scenery::Random;

Polygon square(double x, double y, double side) {
  return shapes::square({x, y}, side);
}

/// A ragged outline about a centre.
Polygon ragged(Random& random, Point centre, double radius, int corners) {
  return transform(Pose{centre, {}}, scenery::random_star(random, corners, 0.7 * radius, 1.3 * radius));
}

TEST(Disjoint, TheOverlapStaysWithTheLarger) {
  const auto trimmed = make_disjoint({square(0, 0, 10), square(5, 5, 20), square(100, 0, 1)}, 0);
  ASSERT_EQ(trimmed.size(), 3U);
  EXPECT_EQ(trimmed[1].pieces, std::vector{square(5, 5, 20)});
  EXPECT_EQ(trimmed[2].pieces, std::vector{square(100, 0, 1)});
  ASSERT_EQ(trimmed[0].pieces.size(), 1U);
  EXPECT_EQ(measure(trimmed[0].pieces[0]).area, 75);
  EXPECT_EQ(trimmed[0].area_trimmed, 25);
  EXPECT_EQ(trimmed[0].yields, std::vector<std::size_t>{1});
  EXPECT_EQ(trimmed[0].rounding_defect, 0);
}

TEST(Disjoint, OfEqualOnesTheFirstKeepsItAndACopyIsGone) {
  const auto trimmed = make_disjoint({square(0, 0, 10), square(0, 0, 10), square(10, 0, 10)}, 0);
  EXPECT_EQ(trimmed[0].pieces.size(), 1U);
  EXPECT_TRUE(trimmed[1].pieces.empty());
  EXPECT_EQ(trimmed[1].area_trimmed, 100);
  EXPECT_EQ(trimmed[2].pieces, std::vector{square(10, 0, 10)}) << "neighbours that touch stay as they are";
  EXPECT_TRUE(trimmed[2].yields.empty());
}

TEST(Disjoint, AFloeThatALargerOneCrossesIsTwo) {
  const Polygon bar{{{-20, 4}, {30, 4}, {30, 6}, {-20, 6}}, {}};
  const auto trimmed = make_disjoint({square(0, 0, 9), bar}, 0);  // 81 and 100 m²
  ASSERT_EQ(trimmed[0].pieces.size(), 2U);
  EXPECT_EQ(exact_area(trimmed[0].pieces[0]) + exact_area(trimmed[0].pieces[1]), 81 - 18);
}

TEST(Disjoint, AGapIsOpenedToTheSmaller) {
  const auto trimmed = make_disjoint({square(0, 0, 10), square(10, 2, 5), square(15.5, 2, 2)}, 1);
  EXPECT_EQ(measure(trimmed[0].pieces[0]).area, 100);
  EXPECT_NEAR(measure(trimmed[1].pieces[0]).area, 20, 1e-6);
  EXPECT_NEAR(bounding_box(trimmed[1].pieces[0].outer).low.x, 11, 1e-6);
  EXPECT_NEAR(bounding_box(trimmed[2].pieces[0].outer).low.x, 16, 1e-6);
  // At a corner the strip is a polygon about the disc: never less than the gap.
  const auto corner = make_disjoint({square(0, 0, 10), square(10.3, 10.3, 4)}, 1);
  for (const Point p : corner[1].pieces[0].outer) EXPECT_GE(distance(p, {10, 10}), 1);
}

/// Whatever overlaps what: nothing does afterwards, all is valid, and the areas add up.
TEST(Disjoint, RaggedCrowdsComeApartAndTheirAreasAddUp) {
  for (const double gap : {0.0, 0.5}) {
    Random random(7);
    std::vector<Polygon> crowd;
    for (int i = 0; i < 120; ++i)
      crowd.push_back(
          ragged(random, {random.between(0, 100), random.between(0, 100)}, random.between(2, 12), 20));
    const auto trimmed = make_disjoint(crowd, gap);
    std::vector<Polygon> pieces;
    std::vector<const Polygon*> after, before;
    double taken = 0;
    for (std::size_t i = 0; i < crowd.size(); ++i) {
      ASSERT_FALSE(trimmed[i].error);
      before.push_back(&crowd[i]);
      taken += trimmed[i].area_trimmed - trimmed[i].rounding_defect;
      for (const Polygon& piece : trimmed[i].pieces) pieces.push_back(piece);
    }
    for (const Polygon& piece : pieces) {
      EXPECT_FALSE(find_defect(piece));
      after.push_back(&piece);
    }
    EXPECT_TRUE(find_overlapping_pairs(pieces, 1).empty());
    const double terms[] = {taken};
    EXPECT_NEAR(exact_balance(after, before, terms), 0, 1e-9);
    EXPECT_GT(taken, 100);
  }
}

TEST(Simplified, EveryVertexStaysWithinTheTolerance) {
  Random random(11);
  for (int i = 0; i < 30; ++i) {
    Polygon polygon = ragged(random, {50, -20}, 100, 60);
    polygon.holes.push_back({{48, -18}, {52, -18}, {52, -22}, {48, -22}});
    const double tolerance = random.between(0.5, 8);
    const Polygon fewer = simplified(polygon, tolerance);
    EXPECT_FALSE(find_defect(fewer));
    EXPECT_LT(vertex_count(fewer), vertex_count(polygon));
    for (const Point p : polygon.outer) {
      double nearest = 1e9;
      for (std::size_t k = 0; k < fewer.outer.size(); ++k)
        nearest = std::min(nearest,
                           distance_to_segment(p, fewer.outer[k], fewer.outer[(k + 1) % fewer.outer.size()]));
      EXPECT_LE(nearest, tolerance * (1 + 1e-12));
    }
  }
  EXPECT_EQ(simplified(square(0, 0, 4), 0.5).outer.size(), 4U);
}

Polygon box(double x, double y, double w, double h) {
  return shapes::rectangle(x, y, x + w, y + h);
}

Polygon turned(const Polygon& polygon, double angle) {
  return transform(Pose{{3, 4}, Rotation::by(angle)}, polygon);
}

TEST(OverlappingPairs, SharedEdgesAndCornersAreNone) {
  for (const double angle : {0.0, 0.3, 1.0, 2.5}) {
    EXPECT_TRUE(find_overlapping_pairs({turned(box(0, 0, 10, 10), angle), turned(box(10, 0, 10, 10), angle),
                                        turned(box(10, 10, 5, 5), angle), turned(box(-7, -7, 7, 7), angle)},
                                       100)
                    .empty());
  }
}

TEST(Overlap, IsRefusedBeyondWhatAreasCanExpress) {
  const Shape near{{{{0, 0}, {9, 0}, {0, 9}}, {}}};
  for (const double far : {1e71, 1e300, std::numeric_limits<double>::infinity()}) {
    const auto found = overlap(near, {}, Shape{{{{0, 0}, {far, 0}, {0, far}}, {}}}, {});
    ASSERT_FALSE(found.has_value());
    EXPECT_EQ(found.error().reason, CutFailure::kInvalidShape);
  }
  EXPECT_EQ(overlap(near, {}, Shape{{{{0, 0}, {1e60, 0}, {0, 1e60}}, {}}}, {})->area, 40.5);
}

TEST(OverlappingPairs, TellsPairsWithTheirArea) {
  for (const double angle : {0.0, 0.3, 1.0}) {
    const auto found =
        find_overlapping_pairs({turned(box(0, 0, 10, 10), angle), turned(box(20, 0, 4, 4), angle),
                                turned(box(9, 2, 3, 3), angle), turned(box(2, 2, 1, 1), angle)},
                               100);
    ASSERT_EQ(found.size(), 2U);
    EXPECT_EQ(found[0].first, 0U);
    EXPECT_EQ(found[0].second, 2U);
    EXPECT_NEAR(found[0].area, 3.0, 1e-9);
    EXPECT_EQ(found[1].second, 3U);
    EXPECT_NEAR(found[1].area, 1.0, 1e-9);
  }
}

TEST(OverlappingPairs, AFloeMayLieInAnothersHoleOrBay) {
  Polygon ring = box(0, 0, 10, 10);
  ring.holes.push_back({{2, 2}, {2, 8}, {8, 8}, {8, 2}});
  EXPECT_TRUE(find_overlapping_pairs({ring, box(3, 3, 4, 4)}, 100).empty());
  EXPECT_TRUE(find_overlapping_pairs({ring, box(2, 2, 6, 6)}, 100).empty());  // fills it
  EXPECT_EQ(find_overlapping_pairs({ring, box(3, 3, 6, 4)}, 100).size(), 1U);
  const Polygon bay{{{0, 0}, {10, 0}, {10, 10}, {8, 10}, {8, 2}, {2, 2}, {2, 10}, {0, 10}}, {}};
  EXPECT_TRUE(find_overlapping_pairs({bay, box(3, 3, 4, 4)}, 100).empty());
  EXPECT_EQ(find_overlapping_pairs({bay, box(3, 1, 4, 4)}, 100).size(), 1U);
}

/// The grid finds the pairs that looking at all pairs finds.
TEST(OverlappingPairs, AgreesWithAllPairs) {
  Random random(5);
  std::vector<Polygon> boxes;
  for (int i = 0; i < 150; ++i)
    boxes.push_back(box(random.between(0, 100), random.between(0, 100), random.between(0.5, 12),
                        random.between(0.5, 12)));
  boxes.push_back(box(-20, 50, 400, 1));  // one that reaches over everything
  std::vector<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t i = 0; i < boxes.size(); ++i) {
    for (std::size_t j = i + 1; j < boxes.size(); ++j) {
      const auto a = geometry::bounding_box(boxes[i].outer);
      const auto b = geometry::bounding_box(boxes[j].outer);
      const double w = std::min(a.high.x, b.high.x) - std::max(a.low.x, b.low.x);
      const double h = std::min(a.high.y, b.high.y) - std::max(a.low.y, b.low.y);
      if (w > 0 && h > 0 && w * h > kTouchingArea) expected.emplace_back(i, j);
    }
  }
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const OverlappingPair& o : find_overlapping_pairs(boxes, 100'000))
    found.emplace_back(o.first, o.second);
  EXPECT_GT(expected.size(), 20U);
  EXPECT_EQ(found, expected);
  EXPECT_EQ(find_overlapping_pairs(boxes, 3).size(), 3U);
}

}  // namespace
}  // namespace polynya::geometry
