// Whether there is room, and how much of a piece lies in a band: in doubles.
#include "geometry/contact/clearance.hpp"

#include <gtest/gtest.h>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/band_area.hpp"

namespace polynya::geometry {
namespace {

Polygon square(double low, double high) {
  return {{{low, low}, {high, low}, {high, high}, {low, high}}, {}};
}
Polygon frame() {
  return {square(-10, 10).outer, {{{-4, -4}, {-4, 4}, {4, 4}, {4, -4}}}};
}

bool is_clear_at(const Polygon& a, const Polygon& b, Point place, double turn = 0) {
  return is_clear(make_outline(a), make_outline(b), {place, Rotation::by(turn)});
}

TEST(Clearance, BodiesApartAreClearAndBodiesThatCrossAreNot) {
  EXPECT_TRUE(is_clear_at(square(-1, 1), square(-1, 1), {2.01, 0}));
  EXPECT_FALSE(is_clear_at(square(-1, 1), square(-1, 1), {1.99, 0}));
  EXPECT_FALSE(is_clear_at(square(-1, 1), square(-1, 1), {2.3, 0}, 0.785)) << "a corner reaches in";
  EXPECT_TRUE(is_clear_at(square(-1, 1), square(-1, 1), {2.5, 0}, 0.785));
}

TEST(Clearance, ABodyInsideAnotherIsNotClearButOneInAHoleIs) {
  EXPECT_FALSE(is_clear_at(square(-5, 5), square(-1, 1), {1, 1}));
  EXPECT_FALSE(is_clear_at(square(-1, 1), square(-5, 5), {1, 1}));
  EXPECT_TRUE(is_clear_at(frame(), square(-1, 1), {0, 0}));
  EXPECT_FALSE(is_clear_at(frame(), square(-1, 1), {7, 0})) << "in the ice of the frame";
  EXPECT_FALSE(is_clear_at(frame(), square(-1, 1), {4, 0})) << "across its edge";
  EXPECT_FALSE(is_clear_at(frame(), square(-3, 3), {0, 0}, 0.785));
}

TEST(Clearance, TheAreaInABandIsWhatIsLeftOfThePolygonThere) {
  EXPECT_NEAR(area_in_band(square(-5, 5), 12), 100, 1e-12) << "all of it";
  EXPECT_NEAR(area_in_band(square(-5, 5), 2), 40, 1e-12);
  EXPECT_NEAR(area_in_band(square(3, 5), 2), 0, 1e-12) << "beside it";
  EXPECT_NEAR(area_in_band(square(1, 5), 2), 4, 1e-12) << "half in";
  EXPECT_NEAR(area_in_band(frame(), 6), 20 * 12 - 64, 1e-12) << "without its hole";
  const Polygon triangle{{{0, 0}, {4, 0}, {0, 4}}, {}};
  EXPECT_NEAR(area_in_band(triangle, 1), 8 - 4.5, 1e-12);
  const Polygon comb{{{0, -3}, {9, -3}, {9, 3}, {6, 3}, {6, -1}, {3, -1}, {3, 3}, {0, 3}}, {}};
  EXPECT_NEAR(area_in_band(comb, 2), 9 * 1 + 2 * 3 * 3, 1e-12) << "not convex: two teeth";
}

}  // namespace
}  // namespace polynya::geometry
