// In doubles: whether there is room, how much of a piece lies in a band, and when two outlines that move in
// straight lines first touch.
#include <gtest/gtest.h>

#include "geometry/contact/boundary.hpp"
#include "geometry/contact/first_contact.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/measures.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

Polygon square(double low, double high) {
  return shapes::rectangle(low, low, high, high);
}
Polygon frame() {
  return {square(-10, 10).outer, {shapes::reversed(square(-4, 4).outer)}};
}

bool is_clear_at(const Polygon& a, const Polygon& b, Point place, double turn = 0) {
  const Pose pose{place, Rotation::by(turn)};
  const bool by_outline = is_clear(make_outline(a), make_outline(b), pose);
  for (const bool has_circles : {false, true})
    EXPECT_EQ(is_clear(make_boundary(a, {1.0, has_circles}), make_outline(b), pose), by_outline);
  return by_outline;
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

/// Through the tree of bounding circles no edge that matters is passed over: a plate with a channel in it,
/// and a piece at places all over it and beside it.
TEST(Clearance, AReadyBoundaryAnswersAsAnOutlineDoes) {
  Polygon plate{{{0, 0}, {600, 0}, {600, 200}, {0, 200}}, {}};
  for (int i = 0; i <= 200; ++i) plate.outer.push_back({0.5 * i, 112 + 0.7 * (i % 2)});
  for (int i = 200; i >= 0; --i) plate.outer.push_back({0.5 * i, 88 - 0.7 * (i % 3)});
  const Boundary outline = make_outline(plate);
  const Boundary ready = make_boundary(plate, {1.0, false});
  ASSERT_LT(ready.cover->pieces.size(), 1200U) << "the rim of 1600 m is in coarse pieces, the channel is not";
  const Boundary piece = make_outline({{{-1, -0.6}, {1.2, -0.5}, {0.9, 0.8}, {-0.8, 0.7}}, {}});
  int clear = 0, blocked = 0;
  for (double x = -3; x < 130; x += 0.83) {
    for (double y = 80; y < 120; y += 0.71) {
      const Pose pose{{x, y}, Rotation::by(x + y)};
      ASSERT_EQ(is_clear(ready, piece, pose), is_clear(outline, piece, pose)) << x << " " << y;
      (is_clear(outline, piece, pose) ? clear : blocked) += 1;
    }
  }
  EXPECT_GT(clear, 1000);
  EXPECT_GT(blocked, 1000);
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

const Ring kSquare = square(0, 2).outer;

Ring moved(const Ring& ring, Vector by) {
  return transform(Pose{Point{} + by, {}}, ring);
}

double shared_area(const Ring& a, const Ring& b) {
  const auto shared = overlap({{a, {}}}, {}, {{b, {}}}, {});
  EXPECT_TRUE(shared.has_value());
  return shared ? shared->area : 0;
}

TEST(FirstContact, OfTwoSquares) {
  const auto touch = first_contact(kSquare, moved(kSquare, {5, 1}), {-0.5, 0}, 0, 100);
  ASSERT_TRUE(touch.has_value());
  EXPECT_DOUBLE_EQ(touch->time, 6);
  EXPECT_EQ(touch->normal, (Vector{1, 0}));
  EXPECT_DOUBLE_EQ(touch->point.x, 2);
  EXPECT_FALSE(first_contact(kSquare, moved(kSquare, {5, 1}), {-0.5, 0}, 0, 5.9)) << "later than asked";
  EXPECT_FALSE(first_contact(kSquare, moved(kSquare, {5, 1}), {0.5, 0}, 0, 100)) << "apart from each other";
  EXPECT_FALSE(first_contact(kSquare, moved(kSquare, {5, 2.5}), {-0.5, 0}, 0, 100)) << "past each other";
  EXPECT_FALSE(first_contact(kSquare, moved(kSquare, {2, 0}), {0, 0.5}, 0, 100)) << "along each other";
  EXPECT_FALSE(first_contact(kSquare, moved(kSquare, {2 + 1e-14, 0}), {0, 0.5}, 0, 100)) << "likewise";
  EXPECT_TRUE(first_contact(kSquare, moved(kSquare, {2 - 1e-12, 0}), {-0.5, 0}, -1, 0)) << "just now";
  EXPECT_TRUE(first_contact(kSquare, moved(kSquare, {3, 3}), {-0.5, -0.5}, 0, 100)) << "corner on corner";
}

// Before the first touch nothing is shared, a little after it something is; where there is none the two pass.
TEST(FirstContact, IsWhereOverlapBegins) {
  scenery::Random random(7);
  const auto star = [&](double radius) {
    return scenery::random_star(random, 9, 0.3 * radius, radius).outer;
  };
  int touching = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Ring a = star(10), b = moved(star(6), {40, random.between(-25, 25)});
    const Vector velocity{-2, random.between(-0.5, 0.5)};
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
