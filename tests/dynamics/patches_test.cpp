// Contact manifolds against closed forms and against the exact area of the overlap; and the circles and edges
// that they are found by.
#include <algorithm>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "geometry/contact/manifolds.hpp"
#include "geometry/cut/overlap.hpp"
#include "geometry/exact/predicates.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using namespace scenery;

// ---- boundaries and what two of them have near each other, against brute force over all edges

bool crosses(Point a, Point b, Point c, Point d) {
  const auto side = [](Point p, Point q, Point r) { return cross(q - p, r - p) > 0; };
  return side(a, b, c) != side(a, b, d) && side(c, d, a) != side(c, d, b);
}

double distance_of_segments(Point a, Point b, Point c, Point d) {
  if (crosses(a, b, c, d)) return 0;
  return std::min({distance_to_segment(a, c, d), distance_to_segment(b, c, d), distance_to_segment(c, a, b),
                   distance_to_segment(d, a, b)});
}

Polygon random_floe(Random& random) {
  switch (random.below(4)) {
    case 0:
      return rectangle(random.between(2, 30), random.between(2, 30));
    case 1: {  // a plate with a hole
      Polygon polygon = random_star(random, 12, 9, 15);
      polygon.holes = {{{-2, -2}, {-3, 4}, {1, 5}, {4, -1}}};
      return polygon;
    }
    case 2:  // many short edges
      return random_star(random, 80, 8, 9);
    default:
      return random_star(random, 4 + random.below(9), 3, 15);
  }
}

class RandomFloes : public ::testing::Test {
 protected:
  Random random_{77};
};

void expect_covered(const EdgeList& edges, const std::vector<BoundaryPiece>& pieces,
                    const std::vector<ContactCircle>& circles, double radius) {
  std::vector<std::vector<std::size_t>> of_edge(edges.size());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    std::uint32_t e = pieces[p].first_edge;
    double along = 0;
    for (std::uint32_t k = 0; k < pieces[p].edges; ++k, e = edges.next[e]) {
      of_edge[e].push_back(p);
      along += distance(edges.from(e), edges.to(e));
    }
    ASSERT_TRUE(pieces[p].edges == 1 || along <= radius * (1 + 1e-12));
  }
  for (std::uint32_t e = 0; e < edges.size(); ++e) {
    for (int k = 0; k <= 50; ++k) {
      const Point at = edges.from(e) + (k / 50.0) * (edges.to(e) - edges.from(e));
      const auto covers = [&](Point centre, double reach) { return distance(centre, at) <= reach * (1 + 1e-9); };
      ASSERT_TRUE(std::ranges::any_of(of_edge[e],
                                      [&](std::size_t p) {
                                        return covers(circles[p].centre, circles[p].reach) &&
                                               covers(pieces[p].middle, pieces[p].reach);
                                      }))
          << "edge " << e << " at " << k / 50.0;
    }
    ASSERT_GE(static_cast<double>(of_edge[e].size()) * radius, distance(edges.from(e), edges.to(e)) * (1 - 1e-12));
  }
}

TEST_F(RandomFloes, CirclesLieInsideTouchTheBoundaryAndCoverItWithTheirPiecesOneForEachRadiusOfIt) {
  double worst = 0;
  int far_off = 0, all = 0;
  for (int i = 0; i < 300 && !HasFailure(); ++i) {
    SCOPED_TRACE(i);
    const Polygon polygon = random_floe(random_);
    const EdgeList edges = edge_list(polygon);
    const double radius = random_.between(0.2, 3);
    const std::vector<BoundaryPiece> pieces = boundary_pieces(edges, radius);
    const std::vector<ContactCircle> circles = sample_contact_circles(edges, pieces, radius);
    for (const ContactCircle& circle : circles) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::uint32_t e = 0; e < edges.size(); ++e)
        nearest = std::min(nearest, distance_to_segment(circle.centre, edges.from(e), edges.to(e)));
      ASSERT_GT(circle.radius, 0);
      ASSERT_LE(circle.radius, radius);
      ASSERT_TRUE(contains(polygon, circle.centre));
      const double off = std::abs(nearest / circle.radius - 1);
      worst = std::max(worst, off);
      far_off += off > 1e-6;
      ++all;
    }
    ASSERT_EQ(circles.size(), pieces.size());
    ASSERT_LE(static_cast<double>(pieces.size()), perimeter(polygon) / radius + static_cast<double>(edges.size()));
    expect_covered(edges, pieces, circles, radius);
  }
  // Deep in the sharpest corners, where circles measure tenths of a millimetre, shrinking stops a little
  // early.
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(far_off, all / 1000);
}

TEST_F(RandomFloes, NoEdgesWithinTheMarginAreMissedAndTheBoundIsALowerBound) {
  int with_near = 0;
  int apart = 0;
  std::size_t crossings = 0;
  for (int i = 0; i < 3000; ++i) {
    const double radius = random_.between(0.3, 2);
    const Boundary a = make_boundary(random_floe(random_), {radius, i % 3 == 0});
    const Boundary b = make_boundary(random_floe(random_), {radius, i % 3 == 0});
    const Pose a_from_b = random_pose(random_, 0, 40);
    const double margin = i % 2 == 0 ? 0 : random_.between(0, 1);
    std::vector<NearPair> circle_pairs;
    NearEdges edges, by_distance;
    const double bound = near_circles(a, b, a_from_b, margin, circle_pairs);
    edges_of(a, b, circle_pairs, edges);
    ASSERT_TRUE(have_few_edges(a.edges, b.edges));
    const double bound_by_distance = near_edges(a.edges, b.edges, a_from_b, margin, by_distance);
    for (const auto& pairs : {edges.pairs, by_distance.pairs}) {
      ASSERT_TRUE(std::ranges::is_sorted(pairs));
      ASSERT_EQ(std::ranges::adjacent_find(pairs), pairs.end());
    }
    const std::set<NearPair> found(edges.pairs.begin(), edges.pairs.end());
    const std::set<NearPair> nearest_found(by_distance.pairs.begin(), by_distance.pairs.end());

    double nearest = std::numeric_limits<double>::infinity();
    for (std::uint32_t eb = 0; eb < b.edges.size(); ++eb) {
      const Point b0 = transform(a_from_b, b.edges.from(eb));
      const Point b1 = transform(a_from_b, b.edges.to(eb));
      for (std::uint32_t ea = 0; ea < a.edges.size(); ++ea) {
        const double d = distance_of_segments(a.edges.from(ea), a.edges.to(ea), b0, b1);
        nearest = std::min(nearest, d);
        crossings += d == 0;
        if (d > margin * (1 + 1e-12)) {
          ASSERT_FALSE(nearest_found.contains({ea, eb}));
        }
        if (d > margin * (1 - 1e-12)) continue;
        ASSERT_TRUE(found.contains({ea, eb})) << "pose " << i << ": edges " << d << " m apart";
        ASSERT_TRUE(nearest_found.contains({ea, eb})) << "pose " << i << ": edges " << d << " m apart";
      }
    }
    ++(found.empty() ? apart : with_near);
    ASSERT_LE(bound, nearest * (1 + 1e-12) + (nearest == 0 ? margin : 0));
    if (found.empty()) {
      ASSERT_GT(bound, margin);
    }
    if (nearest_found.empty()) {
      ASSERT_GT(bound_by_distance, margin);
      ASSERT_LE(bound_by_distance, nearest * (1 + 1e-12));
    }
  }
  EXPECT_GT(with_near, 500);
  EXPECT_GT(apart, 500);
  EXPECT_GT(crossings, 3000u);
}

// ---- manifolds

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
  found.left_out = find_manifolds({boundary_a, boundary_b, a_from_b}, edges, scratch, found.manifolds);
  return found;
}

void expect_points(const ContactManifold& manifold, Point p, Point q, double tolerance) {
  const double as_is = std::max(distance(manifold.ends[0], p), distance(manifold.ends[1], q));
  const double swapped = std::max(distance(manifold.ends[0], q), distance(manifold.ends[1], p));
  EXPECT_LT(std::min(as_is, swapped), tolerance);
}

/// Its right face is the line x = 0 from −20 to 20.
Polygon wall() {
  return rectangle(30, 40, {-15, 0});
}

TEST(Patch, OfACornerInAFlatEdgeIsItsTriangle) {
  for (const double tilt : {0.1, 0.5, 0.785, 1.2, 1.5}) {
    for (const double depth : {1e-7, 1e-4, 0.05, 0.3}) {
      // A square with a corner at the origin of its frame and sides along +x and +y. It is turned by tilt − 90°, so
      // that its sides are at `tilt` and at 90° − tilt from the wall's normal.
      const Polygon square = shapes::square({}, 10);
      const Pose pose{{-depth, 3}, Rotation::by(tilt - std::numbers::pi / 2)};
      const Found found = patches_of(wall(), square, pose);
      const ContactManifold manifold = only(found.manifolds);
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

struct Form {
  Polygon a, b;
  Pose a_from_b;
  Vector normal;
  double width, depth, area;
  Point ends[2];
};

/// Squares of 10 m shifted by 3 m along the face: the line joins opposite corners of the stripe of 7 × 0.1 m.
TEST(Patch, OfFacesAndCornersIsThatOfTheClosedForm) {
  const double d = 0.2, stripe = std::hypot(7, 0.1);
  const Polygon diamond = shapes::diamond({-5, 0}, 5);
  for (const Form& form :
       {Form{wall(), rectangle(10, 8), {{5 - 0.25, 2}, {}}, {1, 0}, 8, 0.25, 2, {{0, -2}, {0, 6}}},
        Form{rectangle(10, 10, {-5, 0}),
             rectangle(10, 10),
             {{5 - 0.1, 3}, {}},
             {7 / stripe, 0.1 / stripe},
             stripe,
             -1,
             0.7,
             {{0, -2}, {-0.1, 5}}},
        Form{diamond, diamond, {{10 - 2 * d, 0}, {}}, {1, 0}, 2 * d, 2 * d, 2 * d * d, {{5 - d, d}, {5 - d, -d}}}}) {
    const ContactManifold manifold = only(patches_of(form.a, form.b, form.a_from_b).manifolds);
    EXPECT_NEAR(length(manifold.normal - form.normal), 0, 1e-12);
    EXPECT_NEAR(manifold.width, form.width, 1e-12);
    if (form.depth > 0) {
      EXPECT_NEAR(manifold.depth, form.depth, 1e-12);
    }
    EXPECT_NEAR(manifold.area, form.area, 1e-12);
    expect_points(manifold, form.ends[0], form.ends[1], 1e-12);
  }
}

TEST(Patch, OfThreeTeethOrTwoProngsAreAsMany) {
  const Polygon teeth{{{0, 3}, {2, 2}, {0, 0}, {2, -2}, {0, -3}, {10, -5}, {10, 5}}, {}};
  const auto bites = patches_of(wall(), teeth, {{-0.1, 0}, {}}).manifolds;
  EXPECT_EQ(bites.size(), 3u);
  for (const ContactManifold& m : bites) EXPECT_NEAR(m.normal.x, 1, 1e-12);
  // A fork whose prongs both go through a plank.
  const Polygon fork{{{-3, 0}, {3, 0}, {3, 6}, {2, 6}, {2, 1}, {-2, 1}, {-2, 6}, {-3, 6}}, {}};
  const auto prongs = patches_of(rectangle(20, 1, {0, 4}), fork, {}).manifolds;
  EXPECT_EQ(prongs.size(), 2u);
  for (const ContactManifold& m : prongs) EXPECT_NEAR(m.area, 1, 1e-12);
}

TEST(Patch, BodiesThatDoNotOverlapHaveNone) {
  EXPECT_TRUE(patches_of(wall(), rectangle(10, 8), {{5 + 1e-12, 2}, {}}).manifolds.empty());
  EXPECT_TRUE(patches_of(rectangle(30, 30), rectangle(4, 4), {{0, 0}, {}}).manifolds.empty()) << "one inside the other";
}

/// Returns S by exact arithmetic, as the reference for the rule.
double exact_area(const Polygon& a, const Polygon& b, const Pose& a_from_b) {
  const auto shared = overlap({a}, {}, {b}, a_from_b);
  EXPECT_TRUE(shared.has_value());
  return shared ? shared->area : 0;
}

double area_of(const Found& found) {
  double area = 0;
  for (const ContactManifold& manifold : found.manifolds) area += manifold.area;
  return area;
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
        const double exact = exact_area(fixed, moving, pose);
        ASSERT_LE(found.manifolds.size(), 1u) << x << ' ' << y << ' ' << turn;
        ++checked;
        const bool is_one_inside_the_other = exact == 8.5 && found.manifolds.empty();
        EXPECT_NEAR(area_of(found), is_one_inside_the_other ? 0 : exact, 1e-12) << x << ' ' << y << ' ' << turn;
      }
    }
  }
  EXPECT_GT(checked, 900);
}

class RandomPatches : public ::testing::Test {
 protected:
  Polygon jagged() { return random_star(random_, 10, 6, 9); }
  Polygon any() { return random_star(random_, 4 + random_.below(8), 2, 9); }
  Polygon convex() {  // points of a circle
    const double radius = random_.between(3, 12);
    return random_star(random_, 3 + random_.below(9), radius, radius);
  }
  Random random_{77};
};

TEST_F(RandomPatches, HaveTheOverlapsExactAreaOfConvexFloesInOneWhateverTheCirclesRadius) {
  int checked[2] = {0, 0};
  for (int i = 0; i < 8000; ++i) {
    const bool is_convex = i % 2 == 0;
    const Polygon a = is_convex ? convex() : jagged(), b = is_convex ? convex() : jagged();
    const Pose pose = is_convex ? random_pose(random_, 8, 24) : random_pose(random_, 14, 18);
    const Found found = patches_of(a, b, pose);
    const double exact = exact_area(a, b, pose);
    ASSERT_EQ(found.left_out, 0);
    if (is_convex) {
      ASSERT_EQ(found.manifolds.size(), exact == 0 ? 0u : 1u) << i;
    }
    if (found.manifolds.empty()) continue;
    ++checked[is_convex ? 0 : 1];
    ASSERT_NEAR(area_of(found), exact, 1e-11) << i << " with " << found.manifolds.size() << " manifolds";
    const auto members = [](const ContactManifold& m) { return std::tuple(m.area, m.normal, m.ends[0]); };
    for (const double radius : {3.0, 0.11})  // it does not matter
      ASSERT_TRUE(std::ranges::equal(patches_of(a, b, pose, radius).manifolds, found.manifolds, {}, members, members));
  }
  EXPECT_GT(checked[0], 800);
  EXPECT_GT(checked[1], 400);
}

Pose moved(Pose pose, Vector by) {
  pose.position += by;
  return pose;
}

Pose turned(const Pose& pose, double by) {  // about the origin
  const Pose turn{{}, Rotation::by(by)};
  const Vector x = rotate(turn.rotation, Vector{pose.rotation.cosine, pose.rotation.sine});
  return {transform(turn, pose.position), {x.x, x.y}};
}

// The gradient of the rule over all patches of a pair equals the gradient of the overlap area, for shallow, deep and
// pierced overlaps.
TEST_F(RandomPatches, TheirWidthsAndNormalsAreTheGradientOfTheOverlapsArea) {
  constexpr double kShift = 1e-5;  // S is piecewise quadratic: central differences are exact but for corners
  int plain = 0, pierced = 0, corners = 0;
  for (int i = 0; i < 600; ++i) {
    Polygon a = any();
    const Polygon b = any();
    if (i % 3 == 0) a.holes.push_back({{-0.5, -0.5}, {-0.5, 0.5}, {0.5, 0.5}, {0.5, -0.5}});
    const Pose pose = random_pose(random_, 0, 16);
    const Found found = patches_of(a, b, pose);
    Vector gradient;
    for (const ContactManifold& m : found.manifolds) {
      gradient -= m.width * m.normal;
      ++(m.is_pierced ? pierced : plain);
    }
    if (!found.manifolds.empty()) {
      EXPECT_NEAR(area_of(found), exact_area(a, b, pose), 1e-9) << i;
    }
    const auto slope = [&](Vector by) {
      return (exact_area(a, b, moved(pose, by)) - exact_area(a, b, moved(pose, -by))) / (2 * kShift);
    };
    const Vector expected{slope({kShift, 0}), slope({0, kShift})};
    const double off = length(gradient - expected);
    corners += off > 1e-6;  // a vertex passes an edge within the step
    EXPECT_LT(off, 1e-3) << i;
  }
  EXPECT_LT(corners, 6);
  EXPECT_GT(plain, 100);
  EXPECT_GT(pierced, 100);
}

TEST_F(RandomPatches, ThePiercedOnesTurnAsTheOverlapsAreaDoes) {
  constexpr double kShift = 1e-6;
  int checked = 0, limited = 0;
  for (int i = 0; i < 600; ++i) {
    const Polygon a = any(), b = any();
    const Pose pose = random_pose(random_, 2, 14);
    const Found found = patches_of(a, b, pose);
    if (found.manifolds.size() != 1 || !found.manifolds[0].is_pierced) continue;
    const ContactManifold& m = found.manifolds[0];
    const double slope =
        (exact_area(a, b, turned(pose, kShift)) - exact_area(a, b, turned(pose, -kShift))) / (2 * kShift);
    const Point middle = midpoint(m.ends[0], m.ends[1]);
    const double lever = slope / m.width - dot(m.centroid - Point{}, perpendicular(m.normal));
    const double here = dot(middle - m.centroid, perpendicular(m.normal));
    ++(std::abs(here - lever) < 1e-4 ? checked : limited);  // beyond the overlap it is held within
    EXPECT_LE(distance(middle, m.centroid), m.extent);
  }
  EXPECT_GT(checked, 50);
  EXPECT_LT(limited, checked / 4);
}

TEST(Pierced, AWedgeThroughAPlankIsPushedBackAlongItsAxis) {
  // A wedge along +x passes through a plank of 0.3 m from x = 0 and protrudes from the far side. Per distance
  // of penetration, its overlap grows by the difference between its widths at both faces.
  const double half = 15 * std::numbers::pi / 180;
  const double reach = 4;
  const Polygon wedge{{{reach, 0}, {-20, (20 + reach) * std::tan(half)}, {-20, -(20 + reach) * std::tan(half)}}, {}};
  const Polygon plank = rectangle(0.3, 30, {0.15, 0});
  const ContactManifold m = only(patches_of(wedge, plank, {}).manifolds);
  EXPECT_TRUE(m.is_pierced);
  EXPECT_NEAR(m.width, 2 * 0.3 * std::tan(half), 1e-12);
  EXPECT_NEAR(m.normal.x, 1, 1e-12);
  EXPECT_NEAR(m.depth, 0.3, 1e-12);
  EXPECT_NEAR(m.area, 0.3 * (2 * reach - 0.3) * std::tan(half), 1e-12);
  expect_points(m, {m.centroid.x, 0.3 * std::tan(half)}, {m.centroid.x, -0.3 * std::tan(half)}, 1e-12);
  EXPECT_FALSE(is_inseparable(m.width, m.area, m.extent));
}

TEST(Pierced, AStripThroughAPlankIsInseparable) {
  const auto m = only(patches_of(rectangle(20, 2), rectangle(0.3, 30), {{1, 1}, Rotation::by(0.2)}).manifolds);
  EXPECT_TRUE(m.is_pierced);
  EXPECT_LT(m.width, 1e-12);
  EXPECT_NEAR(m.area, 0.3 * 2 / std::cos(0.2), 1e-12);
  EXPECT_TRUE(is_inseparable(m.width, m.area, m.extent));
}

TEST(Pierced, WhatIsOneInsideTheOtherIsFoundThough) {
  const auto inside = [](const Polygon& a, const Polygon& b, const Pose& pose) {
    return is_one_inside(make_boundary(a, {1}), make_boundary(b, {1}), pose);
  };
  EXPECT_TRUE(inside(rectangle(30, 30), rectangle(4, 4), {{11, 3}, Rotation::by(0.3)}));
  EXPECT_TRUE(inside(rectangle(4, 4), rectangle(30, 30), {{11, 3}, Rotation::by(0.3)}));
  EXPECT_FALSE(inside(rectangle(30, 30), rectangle(4, 4), {{18, 3}, {}}));
  Polygon ring = rectangle(30, 30);
  ring.holes.push_back({{-5, -5}, {-5, 5}, {5, 5}, {5, -5}});
  EXPECT_FALSE(inside(ring, rectangle(4, 4), {{1, 1}, {}})) << "it floats in the hole";
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
  EXPECT_NEAR(deepest, depth, 1e-9) << "circles touch their faces, so that they overlap as much as the floes do";
}

}  // namespace
}  // namespace polynya::geometry
