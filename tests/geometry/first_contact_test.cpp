// When two outlines that move in straight lines first touch.
#include "geometry/contact/first_contact.hpp"

#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/overlap.hpp"

namespace polynya::geometry {
namespace {

constexpr Ring kSquare() {
  return {{0, 0}, {2, 0}, {2, 2}, {0, 2}};
}
Ring moved(Ring ring, Vector by) {
  for (Point& p : ring) p += by;
  return ring;
}

double shared_area(const Ring& a, const Ring& b) {
  const auto shared = overlap({{a, {}}}, {}, {{b, {}}}, {});
  EXPECT_TRUE(shared.has_value());
  return shared ? shared->area : 0;
}

/// A star about the origin: not convex.
Ring star(std::mt19937& dice, double radius) {
  std::uniform_real_distribution<double> share(0.3, 1);
  Ring ring;
  for (int i = 0; i < 9; ++i) {
    const double angle = 2 * 3.14159265358979 * i / 9, r = radius * share(dice);
    ring.push_back({r * std::cos(angle), r * std::sin(angle)});
  }
  return ring;
}

TEST(FirstContact, OfTwoSquares) {
  const auto touch = first_contact(kSquare(), moved(kSquare(), {5, 1}), {-0.5, 0}, 0, 100);
  ASSERT_TRUE(touch.has_value());
  EXPECT_DOUBLE_EQ(touch->time, 6);
  EXPECT_EQ(touch->normal, (Vector{1, 0}));
  EXPECT_DOUBLE_EQ(touch->point.x, 2);
  EXPECT_FALSE(first_contact(kSquare(), moved(kSquare(), {5, 1}), {-0.5, 0}, 0, 5.9)) << "later than asked";
  EXPECT_FALSE(first_contact(kSquare(), moved(kSquare(), {5, 1}), {0.5, 0}, 0, 100))
      << "apart from each other";
  EXPECT_FALSE(first_contact(kSquare(), moved(kSquare(), {5, 2.5}), {-0.5, 0}, 0, 100)) << "past each other";
  EXPECT_FALSE(first_contact(kSquare(), moved(kSquare(), {2, 0}), {0, 0.5}, 0, 100)) << "along each other";
  EXPECT_FALSE(first_contact(kSquare(), moved(kSquare(), {2 + 1e-14, 0}), {0, 0.5}, 0, 100)) << "likewise";
  EXPECT_TRUE(first_contact(kSquare(), moved(kSquare(), {2 - 1e-12, 0}), {-0.5, 0}, -1, 0)) << "just now";
  EXPECT_TRUE(first_contact(kSquare(), moved(kSquare(), {3, 3}), {-0.5, -0.5}, 0, 100)) << "corner on corner";
}

// Before the first touch nothing is shared, a little after it something is; where there is none the two pass.
TEST(FirstContact, IsWhereOverlapBegins) {
  std::mt19937 dice(7);
  std::uniform_real_distribution<double> place(-25, 25);
  int touching = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Ring a = star(dice, 10), b = moved(star(dice, 6), {40, place(dice)});
    const Vector velocity{-2, 0.02 * place(dice)};
    const auto touch = first_contact(a, b, velocity, 0, 60);
    const double end = touch ? touch->time : 60;
    for (int i = 0; i <= 40; ++i) {
      const double time = end * i / 40 * (1 - 1e-9);
      ASSERT_LT(shared_area(a, moved(b, time * velocity)), 1e-6) << "trial " << trial << " at " << time;
    }
    if (!touch) continue;
    ++touching;
    EXPECT_GT(shared_area(a, moved(b, (end + 0.01) * velocity)), 0) << trial;
    EXPECT_GT(-dot(velocity, touch->normal), 0) << "closing";
  }
  EXPECT_GT(touching, 20);
  EXPECT_LT(touching, 60);
}

}  // namespace
}  // namespace polynya::geometry
