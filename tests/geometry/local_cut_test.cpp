// The local path against the general one: wherever both answer they give the same bits.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/internal/cut_paths.hpp"
#include "tests/geometry/trials.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

using namespace trials;

struct Tally {
  int local = 0;
  int general = 0;
  int snap_rounded = 0;
};

/// Cuts by both paths, compares, and gives the pieces of the public function's result.
std::vector<Piece> compare(const Shape& shape, const Knife& knife, Tally& tally) {
  const CutOutcome result = cut(shape, knife);
  EXPECT_TRUE(is_sound(shape, result)) << to_code(shape.polygon) << to_code(knife);
  const auto local = cut_locally(shape.polygon, {knife.points, knife.is_ring});
  ++(local ? tally.local : tally.general);
  if (local) {
    EXPECT_TRUE(are_equal(*local, cut_generally(shape, knife))) << to_code(shape.polygon) << to_code(knife);
  }
  if (!result) return {};
  tally.snap_rounded += result->ledger.snap_rounded;
  return result->pieces;
}

TEST(LocalCut, EqualsTheGeneralOneOverRandomFloes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-2, 12);
  Tally tally;
  for (int run = 0; run < 12; ++run) {
    std::vector<Shape> shapes{Shape{{{{0, 0}, {10, 0.5}, {9.7, 10}, {-0.3, 9.9}}, {}}}};
    for (int i = 0; i < 60 && !HasFailure(); ++i) {
      const Shape shape = shapes[random() % shapes.size()];
      Ring points;
      for (int k = 0; k < 3; ++k) points.push_back({place(random), place(random)});
      const Knife knife = i % 3 != 0 ? Knife{true, disc_polygon(points[0], 1.5, 0.02)} : Knife{false, points};
      for (const Piece& piece : compare(shape, knife, tally)) shapes.push_back(piece.shape);
    }
  }
  EXPECT_GT(tally.local, 20 * tally.general) << tally.general;
  EXPECT_EQ(tally.snap_rounded, 0);
}

TEST(LocalCut, EqualsTheGeneralOneOnAnIntegerGrid) {
  // Every degeneracy: through vertices, along edges, through earlier cuts' vertices, holes touching their
  // shell.
  std::mt19937 random(12);
  Tally tally;
  const auto coordinate = [&] { return static_cast<double>(static_cast<int>(random() % 9) - 1); };
  for (int run = 0; run < 60; ++run) {
    std::vector<Shape> all{Shape{shapes::square({0, 0}, 6)}};
    for (int i = 0; i < 40 && !HasFailure(); ++i) {
      const Shape shape = all[random() % all.size()];
      const Point c{coordinate(), coordinate()}, end{coordinate(), coordinate()};
      if (i % 2 == 1 && c == end) continue;
      Knife knife{false, {c, end}};
      if (i % 2 == 0) {
        const double r = 1 + static_cast<double>(random() % 2);
        const Ring square = shapes::square({c.x - r, c.y - r}, 2 * r).outer;
        knife = {true, random() % 2 == 0 ? square : shapes::diamond({c.x - r, c.y}, r).outer};
      }
      for (const Piece& piece : compare(shape, knife, tally)) all.push_back(piece.shape);
    }
  }
  EXPECT_GT(tally.local, 2 * tally.general) << tally.general;
}

TEST(LocalCut, EqualsTheGeneralOneAcrossHoles) {
  // Cracks that bridge holes, cut through them, dangle between them; discs that open them to the sea.
  const Shape shape{{{{0, 0}, {12, 0.3}, {12.1, 9}, {-0.2, 9.3}},
                     {{{2, 2}, {2.5, 6}, {4, 5}},
                      {{6, 1}, {5.5, 4}, {7, 4.2}},
                      {{8, 5}, {8.2, 7.7}, {10, 8}, {9.7, 5.1}}}}};
  std::mt19937 random(13);
  std::uniform_real_distribution<double> place(-1, 13);
  Tally tally;
  for (int i = 0; i < 400 && !HasFailure(); ++i) {
    Ring crack;
    for (int k = 0; k < 2 + i % 3; ++k) crack.push_back({place(random), place(random)});
    // In order of x it cannot cross itself, which the local path takes for granted.
    std::sort(crack.begin(), crack.end(), [](Point a, Point b) { return a.x < b.x; });
    compare(shape, {false, crack}, tally);
    compare(shape, {true, disc_polygon({place(random), place(random)}, 0.3 * (1 + i % 12), 0.02)}, tally);
  }
  EXPECT_EQ(tally.general, 0);
  EXPECT_EQ(tally.local, 800);
}

}  // namespace
}  // namespace polynya::geometry
