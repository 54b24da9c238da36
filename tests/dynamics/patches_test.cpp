// Contact manifolds against closed forms and against the exact area of the overlap.
#include <algorithm>

#include <gtest/gtest.h>

#include "geometry/contact/boundary.hpp"
#include "geometry/cut/overlap.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using namespace scenery;

constexpr std::uint64_t kSeed = 77;

struct Found {
  std::vector<ContactManifold> manifolds;
  int left_out = 0;
};

Found patches_of(const Polygon& a, const Polygon& b, const Pose& a_from_b, double radius = 1) {
  const Boundary boundary_a = make_boundary(a, {radius});
  const Boundary boundary_b = make_boundary(b, {radius});
  std::vector<NearPair> circles;
  NearEdges edges;
  near_circles(boundary_a, boundary_b, a_from_b, 0, circles);
  edges_of(boundary_a, boundary_b, circles, edges);
  ManifoldScratch scratch;
  Found found;
  found.left_out = find_manifolds(boundary_a, boundary_b, a_from_b, edges, scratch, found.manifolds);
  return found;
}

void expect_points(const ContactManifold& manifold, Point p, Point q, double tolerance) {
  const double as_is = std::max(distance(manifold.ends[0], p), distance(manifold.ends[1], q));
  const double swapped = std::max(distance(manifold.ends[0], q), distance(manifold.ends[1], p));
  EXPECT_LT(std::min(as_is, swapped), tolerance);
}

// A wall whose right face is the line x = 0 from −20 to 20.
Polygon wall() {
  return rectangle(30, 40, {-15, 0});
}

TEST(Patch, OfACornerInAFlatEdgeIsItsTriangle) {
  for (const double tilt : {0.1, 0.5, 0.785, 1.2, 1.5}) {
    for (const double depth : {1e-7, 1e-4, 0.05, 0.3}) {
      // The corner of a square at the origin of its frame, its sides along +x and +y; turned by tilt − 90°,
      // so that they leave at `tilt` from the wall's normal on one side and at 90° − tilt on the other.
      const Polygon square{{{0, 0}, {10, 0}, {10, 10}, {0, 10}}, {}};
      const Pose pose{{-depth, 3}, Rotation::by(tilt - std::numbers::pi / 2)};
      const Found found = patches_of(wall(), square, pose);
      ASSERT_EQ(found.manifolds.size(), 1u);
      const ContactManifold& manifold = found.manifolds[0];
      const double up = depth * std::tan(tilt);
      const double down = depth * std::tan(std::numbers::pi / 2 - tilt);
      EXPECT_NEAR(manifold.normal.x, 1, 1e-9);
      EXPECT_NEAR(manifold.width / (up + down), 1, 1e-6);
      EXPECT_NEAR(manifold.depth / depth, 1, 1e-6);
      EXPECT_NEAR(manifold.area / (0.5 * depth * (up + down)), 1, 1e-5);
      EXPECT_LT(distance(manifold.tip_of_b, {-depth, 3}), 1e-12);
      EXPECT_EQ(manifold.tip_edge_of_b, 0u);
      expect_points(manifold, {0, 3 + up}, {0, 3 - down}, 1e-9);
      EXPECT_EQ(found.left_out, 0);
    }
  }
}

TEST(Patch, OfFaceToFaceIsTheSharedStripe) {
  const Found found = patches_of(wall(), rectangle(10, 8), {{5 - 0.25, 2}, {}});
  ASSERT_EQ(found.manifolds.size(), 1u);
  const ContactManifold& manifold = found.manifolds[0];
  EXPECT_EQ(manifold.normal, (Vector{1, 0}));
  EXPECT_NEAR(manifold.width, 8, 1e-12);
  EXPECT_NEAR(manifold.depth, 0.25, 1e-12);
  EXPECT_NEAR(manifold.area, 2, 1e-12);
  expect_points(manifold, {0, -2}, {0, 6}, 1e-12);
}

TEST(Patch, OfOffsetFacesStandsBetweenWhereTheBoundariesCross) {
  // Two squares of 10 m, shifted by 3 m along the face and overlapping by 0.1 m: the line joins opposite
  // corners of the stripe of 7 × 0.1 m.
  const Found found = patches_of(rectangle(10, 10, {-5, 0}), rectangle(10, 10), {{5 - 0.1, 3}, {}});
  ASSERT_EQ(found.manifolds.size(), 1u);
  const ContactManifold& manifold = found.manifolds[0];
  EXPECT_NEAR(manifold.width, std::hypot(7, 0.1), 1e-12);
  EXPECT_NEAR(manifold.area, 0.7, 1e-12);
  EXPECT_NEAR(manifold.normal.x, 7 / std::hypot(7, 0.1), 1e-12);
  expect_points(manifold, {0, -2}, {-0.1, 5}, 1e-12);
}

TEST(Patch, OfCornerToCornerIsTheRhombus) {
  // Two squares standing on their corners, the corners overlapping by 2 d: a square of diagonal 2 d.
  const double d = 0.2;
  const Polygon diamond{{{5, 0}, {0, 5}, {-5, 0}, {0, -5}}, {}};
  const Found found = patches_of(diamond, diamond, {{10 - 2 * d, 0}, {}});
  ASSERT_EQ(found.manifolds.size(), 1u);
  EXPECT_NEAR(found.manifolds[0].normal.x, 1, 1e-12);
  EXPECT_NEAR(found.manifolds[0].width, 2 * d, 1e-12);
  EXPECT_NEAR(found.manifolds[0].depth, 2 * d, 1e-12);
  EXPECT_NEAR(found.manifolds[0].area, 2 * d * d, 1e-12);
  expect_points(found.manifolds[0], {5 - d, d}, {5 - d, -d}, 1e-12);
}

TEST(Patch, OfThreeTeethAreThree) {
  const Polygon teeth{{{0, 3}, {2, 2}, {0, 0}, {2, -2}, {0, -3}, {10, -5}, {10, 5}}, {}};
  const Found found = patches_of(wall(), teeth, {{-0.1, 0}, {}});
  ASSERT_EQ(found.manifolds.size(), 3u);
  for (const ContactManifold& manifold : found.manifolds) EXPECT_NEAR(manifold.normal.x, 1, 1e-12);
}

TEST(Patch, BodiesThatDoNotOverlapHaveNone) {
  EXPECT_TRUE(patches_of(wall(), rectangle(10, 8), {{5 + 1e-12, 2}, {}}).manifolds.empty());
  EXPECT_TRUE(patches_of(rectangle(30, 30), rectangle(4, 4), {{0, 0}, {}}).manifolds.empty())
      << "one inside the other";
}

TEST(Patch, OnAGridWhereEverythingTouchesConvexFloesHaveTheirExactOverlap) {
  // Every coincidence of vertices and edges that whole numbers allow: vertex on vertex, vertex on edge, edge
  // on edge.
  const Polygon fixed{{{0, 1}, {1, 0}, {5, 0}, {6, 1}, {6, 4}, {0, 4}}, {}};
  const Polygon moving{{{0, 0}, {3, 0}, {3, 2}, {2, 3}, {0, 3}}, {}};
  int checked = 0;
  for (int turn = 0; turn < 4; ++turn) {
    const Rotation quarter{turn % 2 == 0 ? 1.0 - turn : 0.0, turn % 2 == 1 ? 2.0 - turn : 0.0};
    for (int x = -5; x <= 10; ++x) {
      for (int y = -5; y <= 9; ++y) {
        const Pose pose{{static_cast<double>(x), static_cast<double>(y)}, quarter};
        const Found found = patches_of(fixed, moving, pose);
        const auto exact = overlap({fixed}, {}, {moving}, pose);
        ASSERT_TRUE(exact);
        if (found.manifolds.size() > 1) continue;  // they stand in each other
        ++checked;
        double area = 0;
        for (const ContactManifold& manifold : found.manifolds) area += manifold.area;
        const bool is_one_inside_the_other = exact->area == 8.5 && found.manifolds.empty();
        EXPECT_NEAR(area, is_one_inside_the_other ? 0 : exact->area, 1e-12) << x << ' ' << y << ' ' << turn;
      }
    }
  }
  EXPECT_GT(checked, 900);
}

// Convex: points of a circle.
Polygon random_convex(Random& random) {
  const double radius = random.between(3, 12);
  return random_star(random, 3 + random.below(9), radius, radius);
}

class RandomPatches : public ::testing::Test {
 protected:
  void SetUp() override { RecordProperty("seed", std::to_string(kSeed)); }
  Random random_{kSeed};
};

TEST_F(RandomPatches, OfConvexFloesHaveTheOverlapsExactArea) {
  int checked = 0;
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const Polygon a = random_convex(random_);
    const Polygon b = random_convex(random_);
    const double away = random_.between(8, 24);
    const double towards = random_.angle();
    const Pose pose{{away * std::cos(towards), away * std::sin(towards)}, Rotation::by(random_.angle())};
    const Found found = patches_of(a, b, pose);
    const auto exact = overlap({a}, {}, {b}, pose);
    ASSERT_TRUE(exact);
    if (found.manifolds.size() > 1) continue;  // they stand in each other
    ASSERT_EQ(found.manifolds.empty(), exact->area == 0) << i;
    if (found.manifolds.empty()) continue;
    ++checked;
    worst = std::max(worst, std::abs(found.manifolds[0].area - exact->area));
  }
  std::printf("areas off by up to %.2g m2 over %d overlaps\n", worst, checked);
  EXPECT_LT(worst, 1e-11);
  EXPECT_GT(checked, 800);
}

TEST_F(RandomPatches, OfJaggedFloesSumToTheOverlapsExactArea) {
  int checked = 0;
  double worst = 0;
  for (int i = 0; i < 4000; ++i) {
    const Polygon a = random_star(random_, 10, 6, 9);
    const Polygon b = random_star(random_, 10, 6, 9);
    const double away = random_.between(14, 18);
    const double towards = random_.angle();
    const Pose pose{{away * std::cos(towards), away * std::sin(towards)}, Rotation::by(random_.angle())};
    const Found found = patches_of(a, b, pose);
    const auto exact = overlap({a}, {}, {b}, pose);
    ASSERT_TRUE(exact);
    ASSERT_EQ(found.left_out, 0);
    if (found.manifolds.empty()) continue;
    ++checked;
    double area = 0;
    for (const ContactManifold& manifold : found.manifolds) area += manifold.area;
    worst = std::max(worst, std::abs(area - exact->area));
    ASSERT_LT(worst, 1e-11) << i << " with " << found.manifolds.size() << " manifolds";
  }
  std::printf("areas off by up to %.2g m2 over %d overlaps\n", worst, checked);
  EXPECT_GT(checked, 400);
}

TEST_F(RandomPatches, SwappingTheBodiesFlipsTheNormalAndChangesNothingElse) {
  int checked = 0;
  for (int i = 0; i < 3000; ++i) {
    const Polygon a = random_star(random_, 10, 6, 9);
    const Polygon b = random_star(random_, 10, 6, 9);
    const double away = random_.between(14, 18);
    const double towards = random_.angle();
    const Pose a_from_b{{away * std::cos(towards), away * std::sin(towards)}, Rotation::by(random_.angle())};
    const Pose b_from_a = relative_pose(a_from_b, {});
    std::vector<ContactManifold> ab = patches_of(a, b, a_from_b).manifolds;
    std::vector<ContactManifold> ba = patches_of(b, a, b_from_a).manifolds;
    ASSERT_EQ(ab.size(), ba.size()) << i;
    for (const ContactManifold& manifold : ab) {
      const auto same = std::find_if(ba.begin(), ba.end(), [&](const ContactManifold& other) {
        return distance(midpoint(manifold.ends[0], manifold.ends[1]),
                        transform(a_from_b, midpoint(other.ends[0], other.ends[1]))) < 1e-9;
      });
      ASSERT_NE(same, ba.end()) << i;
      ++checked;
      EXPECT_NEAR(length(rotate(a_from_b.rotation, same->normal) + manifold.normal), 0, 1e-6);
      EXPECT_NEAR(same->width, manifold.width, 1e-10);
      EXPECT_NEAR(same->depth, manifold.depth, 1e-9);
      EXPECT_NEAR(same->area, manifold.area, 1e-10);
    }
  }
  EXPECT_GT(checked, 500);
}

TEST_F(RandomPatches, TheCircleRadiusDoesNotMatterToThem) {
  for (int i = 0; i < 300; ++i) {
    const Polygon a = random_star(random_, 9, 5, 9);
    const Polygon b = random_star(random_, 9, 5, 9);
    const Pose pose{{random_.between(11, 16), random_.between(-3, 3)}, Rotation::by(random_.angle())};
    const Found coarse = patches_of(a, b, pose, 3);
    const Found fine = patches_of(a, b, pose, 0.11);
    ASSERT_EQ(coarse.manifolds.size(), fine.manifolds.size());
    for (std::size_t k = 0; k < coarse.manifolds.size(); ++k) {
      EXPECT_EQ(coarse.manifolds[k].area, fine.manifolds[k].area);
      EXPECT_EQ(coarse.manifolds[k].normal, fine.manifolds[k].normal);
      EXPECT_EQ(coarse.manifolds[k].ends[0], fine.manifolds[k].ends[0]);
    }
  }
}

TEST(CirclePatch, StandsOnTheLineOfCentresHalfWayIntoTheLens) {
  // Two squares face to face: circles of 1 m, whose centres are 1 m inside the faces.
  const Boundary a = make_boundary(rectangle(10, 2, {-5, 0}), {1, true});
  const Boundary b = make_boundary(rectangle(10, 2), {1, true});
  const double depth = 0.3;
  const Pose pose{{5 - depth, 0}, {}};
  std::vector<NearPair> circles;
  near_circles(a, b, pose, 0.5, circles);
  std::vector<ContactManifold> manifolds;
  find_circle_manifolds(a, b, pose, circles, manifolds);
  ASSERT_FALSE(manifolds.empty());
  double deepest = 0;
  for (const ContactManifold& manifold : manifolds) {
    EXPECT_NEAR(length(manifold.normal), 1, 1e-12);
    EXPECT_GT(manifold.normal.x, 0);
    EXPECT_NEAR(dot(manifold.ends[1] - manifold.ends[0], manifold.normal), 0, 1e-12);
    EXPECT_NEAR(distance(manifold.ends[0], manifold.ends[1]), manifold.width, 1e-12);
    deepest = std::max(deepest, manifold.depth);
  }
  EXPECT_NEAR(deepest, depth, 1e-9)
      << "circles touch their faces, so that they overlap as much as the floes do";
}

}  // namespace
}  // namespace polynya::geometry
