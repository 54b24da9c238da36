// Exact operations: the laws that geometry/exact/predicates.hpp numbers, and the test of a point in a ring. The points
// come from a coarse lattice, where nearly all cases are degenerate, or lie a rounding error away from it. Also
// validity, areas and moments.
#include "geometry/exact/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/exact/validity.hpp"
#include "geometry/shape/box_tree.hpp"
#include "tests/dynamics/scenery.hpp"
#include "tests/shapes.hpp"

namespace polynya::geometry {
namespace {

using scenery::Random;

Point any_point(Random& random) {
  const auto coordinate = [&] {
    const double x = 0.1 * (random.below(9) - 4);
    return random.below(4) > 0 ? x : std::nextafter(x, random.below(2) > 0 ? 1.0 : -1.0);
  };
  return {coordinate(), coordinate()};
}

TEST(Predicates, SignsAreThoseOfTheirLaws) {
  Random random(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const Point a = any_point(random), b = any_point(random), c = any_point(random), d = any_point(random);
    const int turn = cross_sign(a, b, c, d);
    ASSERT_EQ(cross_sign(c, d, a, b), -turn) << "law 1";
    ASSERT_EQ(cross_sign(b, a, c, d), -turn) << "law 1";
    ASSERT_EQ(orientation(b, c, a), orientation(a, b, c)) << "law 2";
    ASSERT_EQ(orientation(c, b, a), -orientation(a, b, c)) << "law 2";
    ASSERT_EQ(orientation(a, b, a), 0) << "law 3";
    ASSERT_EQ(dot_sign(c, d, a, b), dot_sign(a, b, c, d)) << "law 4";
    ASSERT_EQ(dot_sign(b, a, c, d), -dot_sign(a, b, c, d)) << "law 4";
    ASSERT_EQ(area_sign({a, b, c, d}), -area_sign({d, c, b, a})) << "law 7";
    ASSERT_EQ(area_sign({a, b, c, d}), area_sign({b, c, d, a})) << "law 7";
  }
}

TEST(Predicates, MeetingsDoNotDependOnTheOrderOfEnds) {
  Random random(2);
  for (int trial = 0; trial < 20000; ++trial) {
    const Point a = any_point(random), b = any_point(random), c = any_point(random), d = any_point(random);
    if (a == b || c == d) continue;
    const SegmentMeeting meeting = meet(a, b, c, d);
    for (const SegmentMeeting& other : {meet(c, d, a, b), meet(b, a, c, d), meet(a, b, d, c)})
      ASSERT_EQ(other.kind, meeting.kind) << "law 5";
    if (meeting.kind == Meeting::kTouch || meeting.kind == Meeting::kOverlap) {
      ASSERT_TRUE(meeting.at == a || meeting.at == b || meeting.at == c || meeting.at == d) << "law 6";
    }
  }
}

TEST(Predicates, DirectionsAreInAWeakOrder) {
  Random random(3);
  for (int trial = 0; trial < 20000; ++trial) {
    Ray rays[4];
    for (Ray& ray : rays) {
      while (ray.tail == ray.head) ray = {any_point(random), any_point(random)};
    }
    const auto& [from, a, b, c] = rays;
    ASSERT_FALSE(met_before(from, a, b) && met_before(from, b, a)) << "law 8";
    ASSERT_FALSE(met_before(from, a, b) && met_before(from, b, c) && !met_before(from, a, c)) << "law 8";
    if (met_before(from, a, b) || met_before(from, b, a)) continue;
    ASSERT_EQ(cross_sign(a, b), 0) << "law 8";
  }
}

/// Off the boundary, the parity of crossings is the side; and a ring turned or reversed has the same sides.
TEST(Predicates, APointIsInARingWhereItsRayCrossesItOnceMore) {
  Random random(4);
  for (int trial = 0; trial < 20000; ++trial) {
    Ring ring;
    for (int i = 0; i < 5; ++i) ring.push_back(any_point(random));
    const Point p = any_point(random);
    bool is_odd = false;
    for (std::size_t i = 0; i < ring.size(); ++i) is_odd ^= crosses_ray(ring[i], ring[(i + 1) % ring.size()], p);
    const int side = side_of_ring(ring, p);
    if (side != 0) {
      ASSERT_EQ(side > 0, is_odd);
    }
    std::rotate(ring.begin(), ring.begin() + 2, ring.end());
    ASSERT_EQ(side_of_ring(ring, p), side);
    std::reverse(ring.begin(), ring.end());
    ASSERT_EQ(side_of_ring(ring, p), side);
  }
}

/// A tree finds the same pairs in both orders as a comparison of all pairs.
TEST(BoxTree, FindsAllPairsAndAllNearABox) {
  Random random(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Box> boxes;
    for (int i = random.below(61); i > 0; --i) boxes.push_back(box_around(any_point(random), any_point(random)));
    using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
    Pairs wanted;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        if (overlaps(boxes[i], boxes[j])) wanted.emplace_back(i, j);
      }
    }
    ASSERT_EQ(pairs_of_boxes(boxes), wanted);
    const Box box = box_around(any_point(random), any_point(random));
    std::vector<std::size_t> near_wanted;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (overlaps(boxes[i], box)) near_wanted.push_back(i);
    }
    std::vector<std::size_t> near;
    BoxTree(boxes).for_each_near(box, [&](std::size_t i) {
      near.push_back(i);
      return true;
    });
    ASSERT_EQ(near, near_wanted);
  }
}

// ---- validity

const Ring kSquare{{0, 0}, {10, 0}, {10, 10}, {0, 10}};

std::string defect_of(const Polygon& polygon) {
  const auto found = find_defect(polygon);
  return found ? std::string(name_of(found->defect)) : "valid";
}
std::string defect_of(const Ring& ring) {
  return defect_of(Polygon{ring, {}});
}
std::string defect_with_hole(const Ring& hole) {
  return defect_of(Polygon{kSquare, {hole}});
}
Ring hole_square(Point low, double side) {
  return shapes::reversed(shapes::square(low, side).outer);
}

TEST(Validity, NamesTheDefectsOfOneRing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(defect_of(kSquare), "valid");
  EXPECT_EQ(defect_of(Ring{}), "too-few-points");
  EXPECT_EQ(defect_of(Ring{{1, 1}, {2, 2}}), "too-few-points");
  EXPECT_EQ(defect_of(Ring{{1, 1}, {2, 2}, {1, 1}, {2, 2}}), "too-few-points");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, nan}, {1, 1}}), "not-finite");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {infinity, 0}, {1, 1}}), "not-finite");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, 0}, {1, 0}, {1, 1}}), "repeated-point");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, 0}, {1, 1}, {0, 0}}), "repeated-point");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {1, 1}, {3, 3}, {2, 2}}), "zero-area");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {2, 2}, {2, 0}, {0, 2}}), "self-crossing");
  EXPECT_EQ(defect_of(Ring{{0, 0}, {4, 0}, {4, 4}, {2, 0}, {0, 4}}), "self-crossing") << "a vertex on an edge";
  EXPECT_EQ(defect_of(Ring{{0, 0}, {2, 2}, {4, 0}, {4, 4}, {2, 2}, {0, 4}}), "self-crossing") << "a pinch";
  EXPECT_EQ(defect_of(Ring{{0, 0}, {4, 0}, {4, 4}, {8, 4}, {4, 4}, {0, 4}}), "overlapping-edges") << "a spike";
  EXPECT_EQ(defect_of(Ring{{0, 0}, {0, 1}, {1, 1}, {1, 0}}), "wrong-orientation");
}

TEST(Validity, NamesTheDefectsOfHoles) {
  EXPECT_EQ(defect_with_hole(hole_square({1, 1}, 2)), "valid");
  EXPECT_EQ(defect_with_hole({{1, 1}, {3, 1}, {3, 3}, {1, 3}}), "wrong-orientation");
  EXPECT_EQ(defect_with_hole(hole_square({20, 20}, 2)), "hole-outside");
  EXPECT_EQ(defect_with_hole(hole_square({9, 4}, 2)), "rings-cross");
  EXPECT_EQ(defect_with_hole({{0, 5}, {0, 7}, {2, 6}}), "overlapping-edges");
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 4), hole_square({2, 2}, 1)}}), "holes-overlap");
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 4), hole_square({3, 3}, 4)}}), "rings-cross");
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 4), hole_square({1, 1}, 4)}}), "overlapping-edges");
}

TEST(Validity, HolesMayTouchInPoints) {
  EXPECT_EQ(defect_with_hole({{0, 0}, {3, 6}, {6, 3}}), "valid") << "vertex on vertex";
  EXPECT_EQ(defect_with_hole({{0, 5}, {2, 6}, {2, 4}}), "valid") << "vertex on edge";
  EXPECT_EQ(defect_of({{{0, 0}, {5, 4}, {10, 0}, {10, 10}, {0, 10}}, {{{2, 4}, {3, 6}, {8, 4}}}}), "valid")
      << "the shell's vertex on the hole's edge";
  EXPECT_EQ(defect_of({kSquare, {hole_square({1, 1}, 2), hole_square({3, 3}, 2)}}), "valid");
}

TEST(Validity, TouchesThatCutTheInteriorApartAreDefects) {
  EXPECT_EQ(defect_with_hole({{0, 5}, {5, 10}, {10, 5}, {5, 0}}), "disconnected");
  EXPECT_EQ(defect_of({kSquare, {{{0, 5}, {5, 6}, {5, 4}}, {{5, 5}, {10, 6}, {10, 4}}}}), "overlapping-edges");
  EXPECT_EQ(defect_of({kSquare, {{{0, 5}, {4, 6}, {5, 5}, {4, 4}}, {{5, 5}, {6, 6}, {10, 5}, {6, 4}}}}),
            "disconnected");
  // Three holes in a ring around a bit of ice, each touching the next.
  EXPECT_EQ(
      defect_of(
          {kSquare,
           {{{2, 2}, {5, 3}, {8, 2}, {5, 1}}, {{8, 2}, {6, 5}, {5, 8}, {7, 5}}, {{5, 8}, {4, 5}, {2, 2}, {3, 5}}}}),
      "disconnected");
}

TEST(Validity, RingsThatCrossInTheirVerticesCross) {
  EXPECT_EQ(defect_of({{{0, 0}, {10, 0}, {10, 10}, {5, 10}, {0, 10}}, {{{5, 10}, {4, 12}, {7, 8}, {5, 5}, {3, 8}}}}),
            "rings-cross");
}

TEST(Validity, IsDecidedExactlyOneUlpApart) {
  // The tip of a notch approaches the diagonal from below: it is clear of the diagonal by one ulp, on it, or past it.
  const auto with_tip_at = [](double y) { return Ring{{0, 0}, {3, -3}, {3, 0.4}, {0.5, y}, {3, 0.6}, {1, 1}}; };
  EXPECT_EQ(defect_of(with_tip_at(std::nextafter(0.5, 0.0))), "valid");
  EXPECT_EQ(defect_of(with_tip_at(0.5)), "self-crossing");
  EXPECT_EQ(defect_of(with_tip_at(std::nextafter(0.5, 1.0))), "self-crossing");
}

TEST(Validity, IsNearLinear) {
  // A comb of 10 000 vertices and a spiral, both valid; an n² check of either would visit 5·10⁷ pairs
  // exactly.
  Ring comb{{0, 0}, {5000, 0}};
  for (int tooth = 2499; tooth >= 0; --tooth) {
    const double x = 2 * tooth;
    for (const Point p : {Point{x + 1.5, 100}, Point{x + 1, 1}, Point{x + 0.5, 1}, Point{x, 100}}) comb.push_back(p);
  }
  EXPECT_EQ(defect_of(comb), "valid");
  Ring spiral;
  for (int i = 0; i < 5000; ++i)
    spiral.push_back({(10 + i * 0.01) * std::cos(i * 0.05), (10 + i * 0.01) * std::sin(i * 0.05)});
  for (int i = 4999; i >= 0; --i)
    spiral.push_back({(9.6 + i * 0.01) * std::cos(i * 0.05), (9.6 + i * 0.01) * std::sin(i * 0.05)});
  EXPECT_EQ(defect_of(spiral), "valid");
}

// ---- measures

/// A rectangle of 6 × 4 m with a hole of 2 × 2 m.
const Polygon kHoled{shapes::rectangle(0, 0, 6, 4).outer, {hole_square({1, 1}, 2)}};

TEST(Measures, RectangleWithHoleHasItsClosedForms) {
  const Measures m = measure(kHoled);
  // A = 24 − 4; x_c = (24·3 − 4·2)/20; y_c = (24·2 − 4·2)/20; J_o = Σ A(w² + h²)/12 + A d².
  EXPECT_DOUBLE_EQ(m.area, 20);
  EXPECT_DOUBLE_EQ(m.centroid.x, 3.2);
  EXPECT_DOUBLE_EQ(m.centroid.y, 2);
  const double outer = 24 * (36 + 16) / 12.0 + 24 * (0.2 * 0.2);
  const double hole = 4 * (4 + 4) / 12.0 + 4 * (1.2 * 1.2);
  EXPECT_NEAR(m.second_moment, outer - hole, 1e-12);
  EXPECT_DOUBLE_EQ(perimeter(kHoled), 28);
}

TEST(Measures, ContainsCountsTheBoundaryAndLeavesHolesOut) {
  EXPECT_TRUE(contains(kHoled, {0.5, 0.5}));
  EXPECT_FALSE(contains(kHoled, {2, 2}));
  EXPECT_FALSE(contains(kHoled, {7, 2}));
  for (const Point p : {Point{0, 0}, Point{6, 2}, Point{3, 4}, Point{1, 1}, Point{2, 3}, Point{6, 4}}) {
    EXPECT_TRUE(contains(kHoled, p)) << p.x << ' ' << p.y;
  }
  for (const Point p : {Point{-1, 0}, Point{7, 4}, Point{-1, 4}, Point{7, 0}}) {
    EXPECT_FALSE(contains(kHoled, p)) << p.x << ' ' << p.y;
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

// The rings are triangles whose third corner is within a few steps of the line through the other two, needles, and
// rings of many vertices, near the origin and far from it, tiny and huge.
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
    const exact::Rational in_rationals = exact::area(exact::exactly(ring));  // the same sum, term by term
    const double nearest = exact::nearest_double(in_rationals);
    ASSERT_EQ(exact::area(ring), in_rationals);
    ASSERT_EQ(signed_area(ring), nearest);
    ASSERT_EQ(exact_area({ring, {}}), nearest);
    ASSERT_EQ(measure({ring, {}}).area, nearest);
    positive += nearest > 0 ? 1 : 0;
  }
  EXPECT_GT(positive, 5000);
  // This sliver comes from a random trial. Plain doubles gave its area as −3.5e-18 m².
  const Ring sliver{{9.066274827191009, 9.741807508383557},
                    {10.151854324862311, 9.969288413081589},
                    {10.214251825832536, 9.982363678414115}};
  EXPECT_EQ(measure({sliver, {}}).area, 4.1982189329424393e-18);
}

TEST(Measures, HolesAreTakenOffBeforeTheAreaIsRounded) {
  // The hole leaves a frame as wide as a few steps between doubles. The difference of two rounded areas loses this
  // frame.
  const double wide = 1e4;
  const double step = std::nextafter(wide, 2e4) - wide;
  const Polygon frame{shapes::square({}, wide).outer,
                      {shapes::reversed(shapes::rectangle(step, step, wide - step, wide - 2 * step).outer)}};
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
    const Point mean{ring[0].x / 3 + ring[1].x / 3 + ring[2].x / 3, ring[0].y / 3 + ring[1].y / 3 + ring[2].y / 3};
    const double reach = std::abs(mean.x) + std::abs(mean.y) + size.x + size.y;
    ASSERT_NEAR(m.centroid.x, mean.x, 1e-8 * size.x + 1e-15 * reach);
    ASSERT_NEAR(m.centroid.y, mean.y, 1e-8 * size.y + 1e-15 * reach);
    const double sides =
        squared_length(ring[1] - ring[0]) + squared_length(ring[2] - ring[1]) + squared_length(ring[0] - ring[2]);
    ASSERT_NEAR(m.second_moment, m.area / 36 * sides, 1e-8 * m.area * sides);
  }
  EXPECT_GT(slivers, 100);
}

TEST(ExactArea, SeesWhatSumsOfDoublesLose) {
  // A square of 2^27 m with a corner cut off at 2^-27 m: the areas are 2^54 and 2^-55 m² apart.
  const double large = std::ldexp(1.0, 27);
  const double small = std::ldexp(1.0, -27);
  const Polygon square{{{0, 0}, {large, 0}, {large, large}, {0, large}}, {}};
  const Polygon corner{{{0, 0}, {small, 0}, {0, small}}, {}};
  const Polygon rest{{{small, 0}, {large, 0}, {large, large}, {0, large}, {0, small}}, {}};
  EXPECT_EQ(exact_area(rest), exact_area(square)) << "no double is between them";
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
