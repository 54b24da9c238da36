// The laws that geometry/exact/internal/predicates.hpp numbers, and the test of a point in a ring: for points
// of a coarse lattice, where nearly all is degenerate, and for points a rounding away from it.
#include "geometry/exact/internal/predicates.hpp"

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "geometry/exact/point_in_ring.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry {
namespace {

/// The same numbers with every library.
struct Dice {
  explicit Dice(unsigned seed) : engine(seed) {}
  int whole(int least, int most) {
    return least + static_cast<int>(engine() % static_cast<unsigned>(most - least + 1));
  }
  std::mt19937 engine;
};

Point any_point(Dice& dice) {
  const auto coordinate = [&] {
    const double x = 0.1 * dice.whole(-4, 4);
    return dice.whole(0, 3) > 0 ? x : std::nextafter(x, dice.whole(0, 1) > 0 ? 1.0 : -1.0);
  };
  return {coordinate(), coordinate()};
}

TEST(Predicates, SignsAreThoseOfTheirLaws) {
  Dice dice(1);
  for (int trial = 0; trial < 20000; ++trial) {
    const Point a = any_point(dice), b = any_point(dice), c = any_point(dice), d = any_point(dice);
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
  Dice dice(2);
  for (int trial = 0; trial < 20000; ++trial) {
    const Point a = any_point(dice), b = any_point(dice), c = any_point(dice), d = any_point(dice);
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
  Dice dice(3);
  for (int trial = 0; trial < 20000; ++trial) {
    Ray rays[4];
    for (Ray& ray : rays) {
      while (ray.tail == ray.head) ray = {any_point(dice), any_point(dice)};
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
  Dice dice(4);
  for (int trial = 0; trial < 20000; ++trial) {
    Ring ring;
    for (int i = 0; i < 5; ++i) ring.push_back(any_point(dice));
    const Point p = any_point(dice);
    bool is_odd = false;
    for (std::size_t i = 0; i < ring.size(); ++i)
      is_odd ^= crosses_ray(ring[i], ring[(i + 1) % ring.size()], p);
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

/// Both orders of a tree find what comparing all finds.
TEST(BoxTree, FindsAllPairsAndAllNearABox) {
  Dice dice(5);
  for (int trial = 0; trial < 200; ++trial) {
    std::vector<Box> boxes;
    for (int i = dice.whole(0, 60); i > 0; --i) boxes.push_back(box_around(any_point(dice), any_point(dice)));
    using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;
    Pairs wanted;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      for (std::size_t j = i + 1; j < boxes.size(); ++j) {
        if (overlaps(boxes[i], boxes[j])) wanted.emplace_back(i, j);
      }
    }
    ASSERT_EQ(pairs_of_boxes(boxes), wanted);
    const Box box = box_around(any_point(dice), any_point(dice));
    std::vector<std::size_t> near_wanted;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (overlaps(boxes[i], box)) near_wanted.push_back(i);
    }
    std::vector<std::size_t> near;
    BoxTree(boxes, BoxTree::Order::kAlongRing).for_each_near(box, [&](std::size_t i) {
      near.push_back(i);
      return true;
    });
    ASSERT_EQ(near, near_wanted);
  }
}

}  // namespace
}  // namespace polynya::geometry
