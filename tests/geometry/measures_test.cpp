#include "geometry/measures.hpp"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "geometry/cut.hpp"

namespace polynya::geometry {
namespace {

Ring rectangle(Point low, double width, double height) {
  return {low, {low.x + width, low.y}, {low.x + width, low.y + height}, {low.x, low.y + height}};
}
Ring reversed(Ring ring) {
  return {ring.rbegin(), ring.rend()};
}

TEST(Measures, RectangleWithHoleHasItsClosedForms) {
  const Polygon polygon{rectangle({0, 0}, 6, 4), {reversed(rectangle({1, 1}, 2, 2))}};
  const Measures m = measure(polygon);
  // A = 24 − 4; x_c = (24·3 − 4·2)/20; y_c = (24·2 − 4·2)/20; J_o = Σ A(w² + h²)/12 + A d².
  EXPECT_DOUBLE_EQ(m.area, 20);
  EXPECT_DOUBLE_EQ(m.centroid.x, 3.2);
  EXPECT_DOUBLE_EQ(m.centroid.y, 2);
  const double outer = 24 * (36 + 16) / 12.0 + 24 * (0.2 * 0.2);
  const double hole = 4 * (4 + 4) / 12.0 + 4 * (1.2 * 1.2);
  EXPECT_NEAR(m.second_moment, outer - hole, 1e-12);
  EXPECT_DOUBLE_EQ(perimeter(polygon), 28);
}

TEST(Measures, ConvergeToTheCircleAtSecondOrder) {
  // Inscribed polygons: A_n = πr² (1 − (2/3)(π/n)² + …), so the error falls by four as the sagitta does.
  const double radius = 3;
  double previous = 0;
  for (const double sagitta : {1e-2, 2.5e-3, 6.25e-4}) {
    const double error =
        std::numbers::pi * radius * radius - measure({disc_polygon({5, -2}, radius, sagitta), {}}).area;
    EXPECT_GT(error, 0);
    if (previous > 0) {
      EXPECT_NEAR(previous / error, 4, 0.35);
    }
    previous = error;
  }
}

TEST(Measures, KeepTheirDigitsFarFromTheOrigin) {
  // The offset 2^40 m is a double and so are the shifted vertices: nothing may change at all.
  const double offset = std::ldexp(1.0, 40);
  const Ring near_origin{{0, 0}, {0.5, 0.25}, {0.75, 1}, {-0.25, 0.5}};
  Ring far;
  for (const Point p : near_origin) far.push_back({p.x + offset, p.y - offset});
  const Measures a = measure({near_origin, {}});
  const Measures b = measure({far, {}});
  EXPECT_EQ(a.area, b.area);
  EXPECT_EQ(signed_area(near_origin), signed_area(far));
  EXPECT_NEAR(a.second_moment, b.second_moment, 1e-15);
}

TEST(Measures, ContainsCountsTheBoundaryAndLeavesHolesOut) {
  const Polygon polygon{rectangle({0, 0}, 6, 4), {reversed(rectangle({1, 1}, 2, 2))}};
  EXPECT_TRUE(contains(polygon, {0.5, 0.5}));
  EXPECT_FALSE(contains(polygon, {2, 2}));
  EXPECT_FALSE(contains(polygon, {7, 2}));
  for (const Point p : {Point{0, 0}, Point{6, 2}, Point{3, 4}, Point{1, 1}, Point{2, 3}, Point{6, 4}}) {
    EXPECT_TRUE(contains(polygon, p)) << p.x << ' ' << p.y;
  }
  for (const Point p : {Point{-1, 0}, Point{7, 4}, Point{-1, 4}, Point{7, 0}}) {
    EXPECT_FALSE(contains(polygon, p)) << p.x << ' ' << p.y;
  }
}

TEST(Measures, DiscStaysWithinItsSagitta) {
  for (const double sagitta : {0.5, 0.1, 1e-3}) {
    const Ring ring = disc_polygon({1, 2}, 10, sagitta);
    EXPECT_GT(signed_area(ring), 0);
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Point middle = midpoint(ring[i], ring[(i + 1) % ring.size()]);
      EXPECT_LE(10 - distance(middle, {1, 2}), sagitta * (1 + 1e-12));
      EXPECT_NEAR(distance(ring[i], {1, 2}), 10, 1e-14);
    }
  }
}

}  // namespace
}  // namespace polynya::geometry
