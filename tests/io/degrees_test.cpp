// Rings in longitude and latitude, and polygons that were cut apart.
#include "io/import/degrees.hpp"

#include <cmath>
#include <numbers>
#include <random>

#include "expect_text.hpp"
#include <fmt/format.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "io/import/join.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;

/// Returns a ragged ring of points [longitude, latitude] about a pole, counter-clockwise as seen from above the pole.
Ring about_pole(std::mt19937& dice, double pole, int corners) {
  std::uniform_real_distribution<double> draw(0.2, 1.0);
  Ring ring;
  for (int i = 0; i < corners; ++i) {
    const double turn = 360.0 * i / corners - 180;
    ring.push_back({pole > 0 ? turn : -turn, pole > 0 ? 90 - draw(dice) : -90 + draw(dice)});
  }
  return ring;
}

bool is_same_place(Point a, Point b) {
  return std::abs(std::remainder(a.x - b.x, 360)) < 1e-9 && std::abs(a.y - b.y) < 1e-12;
}

/// Whether two rings have the same places in the same order, from any of them on; other places may
/// lie between them.
bool are_same_ring(const Ring& ring, const Ring& of) {
  for (std::size_t begin = 0; begin < of.size(); ++begin) {
    std::size_t next = 0;
    for (std::size_t i = 0; i < of.size() && next < ring.size(); ++i)
      next += is_same_place(ring[next], of[(begin + i) % of.size()]) ? 1 : 0;
    if (next == ring.size()) return true;
  }
  return false;
}

TEST(Degrees, ARingAboutAPoleIsDrawnWithASeamAndReadWithout) {
  std::mt19937 dice(1);
  for (const double pole : {90.0, -90.0}) {
    for (int corners = 3; corners < 40; ++corners) {
      const Ring ring = about_pole(dice, pole, corners);
      const Polygon drawn = drawn_in_degrees({ring, {}}, 100);
      EXPECT_EQ(std::ranges::count_if(drawn.outer, is_pole), 2);
      EXPECT_FALSE(find_defect(geometry::normalised(drawn)).has_value());
      EXPECT_GT(geometry::signed_area(drawn.outer), 0);
      const auto [west, east] = std::ranges::minmax(drawn.outer, {}, &Point::x);
      EXPECT_NEAR(east.x - west.x, 360, 1e-9);
      const Ring read = without_seams(drawn.outer);
      EXPECT_LE(read.size(), ring.size() + 1) << "one point where the seam begins";
      EXPECT_TRUE(are_same_ring(ring, read)) << corners;
      const Ring again = continuous(read, true);
      for (std::size_t i = 1; i < again.size(); ++i) EXPECT_LE(std::abs(again[i].x - again[i - 1].x), 180);
    }
  }
}

/// The seam of a spiral passes between its arms, and a hole is not crossed where that can be.
TEST(Degrees, ASeamDoesNotCrossTheBoundary) {
  std::mt19937 dice(3);
  Ring arm;  // once and a half around the pole, the pole in its head
  for (int i = 0; i <= 54; ++i) arm.push_back({-180.0 + 10 * i, 90 - 0.2 - 0.01 * i});
  for (int i = 54; i >= 8; --i) arm.push_back({-180.0 + 10 * i, 90 - 0.1 - 0.01 * i});
  const Ring ring = about_pole(dice, 90, 12);
  const Polygon holed{ring, {{{9, 89.9}, {10, 89.95}, {11, 89.9}}}};
  for (const Polygon& floe : {Polygon{arm, {}}, holed}) {
    const Polygon drawn = drawn_in_degrees(floe, 0);
    EXPECT_FALSE(find_defect(geometry::normalised(drawn)).has_value()) << drawn.outer.size();
  }
}

TEST(Degrees, APoleOnTheBoundaryHasTheLongitudesOfItsNeighbours) {
  const Ring corner{{0, 90}, {10, 89.9}, {70, 89.9}};
  const Ring drawn = drawn_in_degrees({corner, {}}, 0).outer;
  ASSERT_EQ(drawn.size(), 4U);
  EXPECT_GT(geometry::signed_area(drawn), 0);
  EXPECT_TRUE(are_same_ring(corner, without_seams(drawn)) || without_seams(drawn).size() == 3U);
  // A half of the surroundings: the pole lies on an edge.
  const Ring half{{-90, 89.9}, {0, 89.95}, {90, 89.9}, {0, 90}};
  const Ring of_half = drawn_in_degrees({half, {}}, 0).outer;
  EXPECT_FALSE(find_defect(geometry::normalised({of_half, {}})).has_value());
  EXPECT_GT(geometry::signed_area(of_half), 0);
  EXPECT_EQ(without_seams(of_half).size(), 4U);
}

TEST(Degrees, EdgesTakeTheShorterWay) {
  const Ring across{{179, 70}, {-179, 70}, {-179, 71}, {179, 71}};
  const Ring read = continuous(across, true);
  EXPECT_EQ(read[1].x, 181);
  EXPECT_EQ(read[3].x, 179);
  EXPECT_EQ(continuous({{539, 70}, {-179, 70}}, false)[1].x, 541);
  EXPECT_EQ(longitude_near(375.6, 0), 375.6 - 360);
  EXPECT_EQ(longitude_near(15.6, 0), 15.6) << "to the bit";
}

Polygon rectangle(double x0, double y0, double x1, double y1) {
  return {{{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}}, {}};
}

TEST(Join, HalvesBecomeOneAndOthersStay) {
  for (const double apart : {0.0, 1e-12, 3e-13, 0.004, -0.004}) {
    // The right half has a vertex on the seam, and the left half has none there.
    Polygon right = rectangle(10 + apart, 0, 20, 10);
    right.outer.push_back({10 + apart, 4});
    const auto joined = join({rectangle(0, 0, 10, 10), right, rectangle(40, 0, 50, 10)}, {0, 0, 0}, 0.01);
    ASSERT_EQ(joined.size(), 1U) << apart;
    EXPECT_EQ(joined[0].members, (std::vector<std::size_t>{0, 1}));
    ASSERT_EQ(joined[0].polygons.size(), 1U);
    EXPECT_FALSE(find_defect(joined[0].polygons[0]).has_value());
    EXPECT_NEAR(geometry::measure(joined[0].polygons[0]).area, 200, 0.05);
  }
  EXPECT_TRUE(join({rectangle(0, 0, 10, 10), rectangle(10, 0, 20, 10)}, {0, 1}, 0.01).empty()) << "of two groups";
  EXPECT_TRUE(join({rectangle(0, 0, 10, 10), rectangle(10.02, 0, 20, 10)}, {0, 0}, 0.01).empty()) << "too far apart";
  EXPECT_TRUE(join({rectangle(0, 0, 10, 10), rectangle(10, 10, 20, 20)}, {0, 0}, 0.01).empty()) << "a corner";
}

TEST(Join, FourQuartersAndARingWithASlitBecomeWhole) {
  const std::vector<Polygon> four{rectangle(0, 0, 1, 1), rectangle(1, 0, 2, 1), rectangle(1, 1, 2, 2),
                                  rectangle(0, 1, 1, 2)};
  const auto quarters = join(four, {5, 5, 5, 5}, 1e-6);
  ASSERT_EQ(quarters.size(), 1U);
  EXPECT_EQ(geometry::measure(quarters[0].polygons.at(0)).area, 4);
  for (const double width : {0.0, 3e-13, 1e-3}) {
    // A square with a slit to its middle.
    const Polygon slit{{{0, 0}, {10, 0}, {10, 5 - width / 2}, {5, 5}, {10, 5 + width / 2}, {10, 10}, {0, 10}}, {}};
    const auto closed = join({slit}, {0}, 0.01);
    ASSERT_EQ(closed.size(), 1U) << width;
    EXPECT_NEAR(geometry::measure(closed[0].polygons.at(0)).area, 100, 0.01);
    EXPECT_FALSE(find_defect(closed[0].polygons[0]).has_value());
    EXPECT_LE(closed[0].polygons[0].outer.size(), 6U);
  }
}

}  // namespace
}  // namespace polynya::io
