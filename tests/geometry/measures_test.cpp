#include "geometry/exact/measures.hpp"

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

using shapes::reversed;

Ring rectangle(Point low, double width, double height) {
  return shapes::rectangle(low.x, low.y, low.x + width, low.y + height).outer;
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

// Triangles whose third corner lies within some steps of the line through the other two, needles, and rings
// of many vertices, near the origin and far from it, tiny and huge.
class AwkwardRings {
 public:
  Ring roll() {
    const double size = std::ldexp(1.0, exponent_(random_));
    const Point centre{size * far_(random_), size * far_(random_)};
    const Point a = around(centre, size);
    const Point b = around(centre, size);
    switch (random_() % 4) {
      case 0: {
        const Point c = a + unit_(random_) * (b - a);
        return {a, b, {near(c.x), near(c.y)}};
      }
      case 1:
        return {a, b, around(b, 1e-12 * size), around(a, 1e-12 * size)};
      case 2:
        return {a, b, around(centre, size)};
      default: {
        Ring ring;
        for (std::size_t i = 0, n = 4 + random_() % 60; i < n; ++i) ring.push_back(around(centre, size));
        return ring;
      }
    }
  }

 private:
  Point around(Point p, double size) { return {p.x + size * unit_(random_), p.y + size * unit_(random_)}; }
  double near(double value) {
    for (auto steps = random_() % 4; steps > 0; --steps) value = std::nextafter(value, 1e300);
    return value;
  }
  std::mt19937_64 random_{7};
  std::uniform_real_distribution<double> unit_{-1, 1};
  std::uniform_int_distribution<int> exponent_{-180, 60};
  std::normal_distribution<double> far_{0, 1000};
};

TEST(Measures, EveryAreaIsTheNearestDouble) {
  AwkwardRings rings;
  int positive = 0;
  for (int trial = 0; trial < 20000; ++trial) {
    const Ring ring = rings.roll();
    const double nearest = exact::nearest_double(exact::area(exact::exactly(ring)));
    ASSERT_EQ(signed_area(ring), nearest);
    ASSERT_EQ(measure({ring, {}}).area, nearest);
    positive += nearest > 0 ? 1 : 0;
  }
  EXPECT_GT(positive, 5000);
  // From a trial: plain doubles made this −3.5e-18 m².
  const Ring sliver{{9.066274827191009, 9.741807508383557},
                    {10.151854324862311, 9.969288413081589},
                    {10.214251825832536, 9.982363678414115}};
  EXPECT_EQ(measure({sliver, {}}).area, 4.1982189329424393e-18);
}

TEST(Measures, HolesAreTakenOffBeforeTheAreaIsRounded) {
  // The hole leaves a frame of some steps between doubles, which the difference of two rounded areas loses.
  const double wide = 1e4;
  const double step = std::nextafter(wide, 2e4) - wide;
  const Polygon frame{rectangle({0, 0}, wide, wide),
                      {reversed(rectangle({step, step}, wide - 2 * step, wide - 3 * step))}};
  const double exactly = exact::nearest_double(exact::area(exact::exactly(frame)));
  EXPECT_GT(exactly, 0);
  EXPECT_EQ(measure(frame).area, exactly);
}

TEST(Measures, SliversHaveTheMomentsOfTheirTriangle) {
  AwkwardRings rings;
  int slivers = 0;
  for (int trial = 0; trial < 5000; ++trial) {
    const Ring ring = rings.roll();
    if (ring.size() != 3 || !(signed_area(ring) > 1e-100)) continue;
    const Measures m = measure({ring, {}});
    const Vector size = bounding_box(ring).high - bounding_box(ring).low;
    slivers += m.area < 1e-6 * size.x * size.y ? 1 : 0;
    const Point mean{ring[0].x / 3 + ring[1].x / 3 + ring[2].x / 3,
                     ring[0].y / 3 + ring[1].y / 3 + ring[2].y / 3};
    const double reach = std::abs(mean.x) + std::abs(mean.y) + size.x + size.y;
    ASSERT_NEAR(m.centroid.x, mean.x, 1e-8 * size.x + 1e-15 * reach);
    ASSERT_NEAR(m.centroid.y, mean.y, 1e-8 * size.y + 1e-15 * reach);
    const double sides = squared_length(ring[1] - ring[0]) + squared_length(ring[2] - ring[1]) +
                         squared_length(ring[0] - ring[2]);
    ASSERT_NEAR(m.second_moment, m.area / 36 * sides, 1e-8 * m.area * sides);
  }
  EXPECT_GT(slivers, 100);
}

// The law behind the exact area: the same sum in plain rationals, term by term, over coordinates of all
// sizes.
TEST(ExactArea, EqualsTheShoelaceSumInRationals) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> mantissa(-1, 1);
  std::uniform_int_distribution<int> exponent(-60, 60);
  for (int trial = 0; trial < 300; ++trial) {
    Ring ring;
    for (int i = 0; i < 3 + trial % 20; ++i) {
      ring.push_back({std::ldexp(mantissa(random), trial % 3 == 0 ? 4 : exponent(random)),
                      i % 5 == 0 ? -0.0 : std::ldexp(mantissa(random), exponent(random))});
    }
    EXPECT_EQ(exact::area(ring), exact::area(exact::exactly(ring)));
    EXPECT_EQ(exact_area({ring, {}}), exact::nearest_double(exact::area(exact::exactly(ring))));
  }
  const double tiny = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(exact::area(Ring{{0, 0}, {tiny, 0}, {0, tiny}}),
            exact::area(exact::exactly(Ring{{0, 0}, {tiny, 0}, {0, tiny}})));
}

TEST(ExactArea, SeesWhatSumsOfDoublesLose) {
  // A square of 2^27 m with a corner cut off at 2^-27 m: the areas are 2^54 and 2^-55 m² apart.
  const double large = std::ldexp(1.0, 27);
  const double small = std::ldexp(1.0, -27);
  const Polygon square{{{0, 0}, {large, 0}, {large, large}, {0, large}}, {}};
  const Polygon corner{{{0, 0}, {small, 0}, {0, small}}, {}};
  const Polygon rest{{{small, 0}, {large, 0}, {large, large}, {0, large}, {0, small}}, {}};
  EXPECT_EQ(exact_area(rest), exact_area(square)) << "no double tells them apart";
  const Polygon* const before[]{&square};
  const Polygon* const both[]{&rest, &corner};
  EXPECT_EQ(exact_balance(both, before, {}), 0);
  EXPECT_EQ(exact_balance({both, 1}, before, {}), -std::ldexp(1.0, -55));
  const double lost[]{std::ldexp(1.0, -55)};
  EXPECT_EQ(exact_balance({both, 1}, before, lost), 0);
}

TEST(ExactArea, WhatIsNotFiniteHasNone) {
  EXPECT_TRUE(std::isnan(exact_area({{{0, 0}, {1, NAN}, {1, 1}}, {}})));
  EXPECT_TRUE(std::isnan(exact_area({{{0, 0}, {1, 0}, {1, 1}}, {{{0, 0}, {INFINITY, 0}, {1, 1}}}})));
  const double term[]{NAN};
  EXPECT_TRUE(std::isnan(exact_balance({}, {}, term)));
}

}  // namespace
}  // namespace polynya::geometry
