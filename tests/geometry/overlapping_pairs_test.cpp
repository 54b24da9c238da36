#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::geometry {
namespace {

Polygon box(double x, double y, double w, double h) {
  return {{{x, y}, {x + w, y}, {x + w, y + h}, {x, y + h}}, {}};
}

Polygon turned(Polygon polygon, double angle) {
  const Pose pose{{3, 4}, Rotation::by(angle)};
  for (Point& p : polygon.outer) p = transform(pose, p);
  for (Ring& hole : polygon.holes) {
    for (Point& p : hole) p = transform(pose, p);
  }
  return polygon;
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
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> place(0, 100);
  std::uniform_real_distribution<double> size(0.5, 12);
  std::vector<Polygon> boxes;
  for (int i = 0; i < 150; ++i)
    boxes.push_back(box(place(random), place(random), size(random), size(random)));
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
