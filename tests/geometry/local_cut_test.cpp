// The local path against the general one: wherever both answer they give the same bits.
#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/measures.hpp"
#include "tests/geometry/trials.hpp"

namespace polynya::geometry {
namespace {

using trials::are_equal;
using trials::is_sound;

struct Tally {
  int local = 0;
  int general = 0;
  int snap_rounded = 0;
  int failed = 0;
};

// Cuts by both paths, compares, and returns the public function's result.
CutOutcome compare_disc(const Shape& shape, const Ring& disc, Tally& tally) {
  CutOutcome result = cut_by_polygon(shape, {disc, {}});
  EXPECT_TRUE(is_sound(shape, result)) << trials::to_code(shape.polygon) << "\n" << trials::to_code(disc);
  const auto local = cut_locally(shape.polygon, {disc, true});
  ++(local ? tally.local : tally.general);
  if (local) {
    EXPECT_TRUE(are_equal(*local, cut_by_polygons_generally(exact::exactly(shape.polygon), {{disc, {}}})))
        << "shape " << trials::to_code(shape.polygon) << "\ndisc " << trials::to_code(disc);
  }
  if (!result) ++tally.failed;
  if (result) tally.snap_rounded += result->ledger.snap_rounded;
  return result;
}

CutOutcome compare_crack(const Shape& shape, const Ring& crack, Tally& tally) {
  CutOutcome result = cut_along(shape, crack);
  EXPECT_TRUE(is_sound(shape, result)) << trials::to_code(shape.polygon) << "\n" << trials::to_code(crack);
  const auto local = cut_locally(shape.polygon, {crack, false});
  ++(local ? tally.local : tally.general);
  if (local) {
    EXPECT_TRUE(are_equal(*local, cut_along_generally(exact::exactly(shape.polygon), crack)))
        << "shape " << trials::to_code(shape.polygon) << "\ncrack " << trials::to_code(crack);
  }
  if (!result) ++tally.failed;
  if (result) tally.snap_rounded += result->ledger.snap_rounded;
  return result;
}

TEST(LocalCut, EqualsTheGeneralOneOverRandomFloes) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> place(-2, 12);
  Tally tally;
  for (int run = 0; run < 12; ++run) {
    std::vector<Shape> shapes{Shape{{{{0, 0}, {10, 0.5}, {9.7, 10}, {-0.3, 9.9}}, {}}}};
    for (int i = 0; i < 60 && !HasFailure(); ++i) {
      const Shape shape = shapes[random() % shapes.size()];
      const CutOutcome outcome =
          i % 3 != 0 ? compare_disc(shape, disc_polygon({place(random), place(random)}, 1.5, 0.02), tally)
                     : compare_crack(shape,
                                     {{place(random), place(random)},
                                      {place(random), place(random)},
                                      {place(random), place(random)}},
                                     tally);
      if (!outcome) continue;
      for (const Piece& piece : outcome->pieces) shapes.push_back(piece.shape);
    }
  }
  RecordProperty("local", tally.local);
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
    std::vector<Shape> shapes{Shape{{{{0, 0}, {6, 0}, {6, 6}, {0, 6}}, {}}}};
    for (int i = 0; i < 40 && !HasFailure(); ++i) {
      const Shape shape = shapes[random() % shapes.size()];
      CutOutcome outcome;
      if (i % 2 == 0) {
        const Point c{coordinate(), coordinate()};
        const double r = 1 + static_cast<double>(random() % 2);
        const Ring square{{c.x - r, c.y - r}, {c.x + r, c.y - r}, {c.x + r, c.y + r}, {c.x - r, c.y + r}};
        const Ring diamond{{c.x - r, c.y}, {c.x, c.y - r}, {c.x + r, c.y}, {c.x, c.y + r}};
        outcome = compare_disc(shape, random() % 2 == 0 ? square : diamond, tally);
      } else {
        const Ring crack{{coordinate(), coordinate()}, {coordinate(), coordinate()}};
        if (crack[0] == crack[1]) continue;
        outcome = compare_crack(shape, crack, tally);
      }
      if (!outcome) continue;
      for (const Piece& piece : outcome->pieces) shapes.push_back(piece.shape);
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
    compare_crack(shape, crack, tally);
    compare_disc(shape, disc_polygon({place(random), place(random)}, 0.3 * (1 + i % 12), 0.02), tally);
  }
  EXPECT_EQ(tally.general, 0);
  EXPECT_EQ(tally.local, 800);
}

}  // namespace
}  // namespace polynya::geometry
