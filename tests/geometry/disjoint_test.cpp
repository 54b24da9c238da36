// Polygons made disjoint, and simplified.
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/box_tree.hpp"
#include "geometry/shape/outline.hpp"

namespace polynya::geometry {
namespace {

/// Uniform numbers, the same everywhere.
class Draw {
 public:
  explicit Draw(unsigned seed) : engine_(seed) {}
  double operator()(double low, double high) {
    return low + (high - low) * static_cast<double>(engine_()) / 4294967296.0;
  }

 private:
  std::mt19937 engine_;
};

Polygon square(double x, double y, double side) {
  return {{{x, y}, {x + side, y}, {x + side, y + side}, {x, y + side}}, {}};
}

/// A ragged outline about a centre.
Polygon ragged(Draw& dice, Point centre, double radius, int corners) {
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * 3.14159265358979 * i / corners;
    const double r = radius * dice(0.7, 1.3);
    polygon.outer.push_back({centre.x + r * std::cos(angle), centre.y + r * std::sin(angle)});
  }
  return polygon;
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
    Draw dice(7);
    std::vector<Polygon> crowd;
    for (int i = 0; i < 120; ++i)
      crowd.push_back(ragged(dice, {dice(0, 100), dice(0, 100)}, dice(2, 12), 20));
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

TEST(BoxPairs, AreThoseThatMeet) {
  Draw dice(3);
  std::vector<Box> boxes;
  for (int i = 0; i < 300; ++i) {
    const Point low{dice(0, 100), dice(0, 100)};
    boxes.push_back({low, low + Vector{dice(0, 9), dice(0, 9)}});
  }
  boxes.push_back({{0, 0}, {100, 100}});
  std::vector<std::pair<std::size_t, std::size_t>> expected;
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      if (overlaps(boxes[i], boxes[j])) expected.emplace_back(i, j);
  EXPECT_EQ(pairs_of_boxes(boxes), expected);
  EXPECT_TRUE(pairs_of_boxes({}).empty());
}

TEST(Simplified, EveryVertexStaysWithinTheTolerance) {
  Draw dice(11);
  for (int i = 0; i < 30; ++i) {
    Polygon polygon = ragged(dice, {50, -20}, 100, 60);
    polygon.holes.push_back({{48, -18}, {52, -18}, {52, -22}, {48, -22}});
    const double tolerance = dice(0.5, 8);
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

}  // namespace
}  // namespace polynya::geometry
