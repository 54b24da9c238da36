// Contact circles, and what two boundaries have near each other, against brute force over all edges.
#include "geometry/contact/boundary.hpp"

#include <algorithm>
#include <set>

#include <gtest/gtest.h>

#include "geometry/exact/point_in_ring.hpp"
#include "tests/dynamics/scenery.hpp"

namespace polynya::geometry {
namespace {

using namespace scenery;

constexpr std::uint64_t kSeed = 31;

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
  Random random_{kSeed};
};

TEST_F(RandomFloes, CirclesLieInsideAndTouchTheBoundary) {
  double worst = 0;
  int far_off = 0;
  int all = 0;
  for (int i = 0; i < 300; ++i) {
    const Polygon polygon = random_floe(random_);
    const EdgeList edges = edge_list(polygon);
    const double radius = random_.between(0.2, 3);
    for (const ContactCircle& circle :
         sample_contact_circles(edges, boundary_pieces(edges, radius), radius)) {
      double nearest = std::numeric_limits<double>::infinity();
      for (std::uint32_t e = 0; e < edges.size(); ++e) {
        nearest = std::min(nearest, distance_to_segment(circle.centre, edges.from(e), edges.to(e)));
      }
      ASSERT_GT(circle.radius, 0);
      ASSERT_LE(circle.radius, radius);
      ASSERT_TRUE(contains(polygon, circle.centre)) << i;
      worst = std::max(worst, std::abs(nearest / circle.radius - 1));
      far_off += std::abs(nearest / circle.radius - 1) > 1e-6;
      ++all;
    }
  }
  // Deep in the sharpest corners, where circles measure tenths of a millimetre, shrinking stops a little
  // early.
  EXPECT_LT(worst, 1e-3);
  EXPECT_LT(far_off, all / 1000);
}

TEST_F(RandomFloes, PiecesAndTheirCirclesCoverAllBoundaryOneForEachRadiusOfIt) {
  for (int i = 0; i < 300; ++i) {
    const Polygon polygon = random_floe(random_);
    const EdgeList edges = edge_list(polygon);
    const double radius = random_.between(0.2, 3);
    const std::vector<BoundaryPiece> pieces = boundary_pieces(edges, radius);
    const std::vector<ContactCircle> circles = sample_contact_circles(edges, pieces, radius);
    ASSERT_EQ(circles.size(), pieces.size());
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
        const auto covers = [&](Point centre, double reach) {
          return distance(centre, at) <= reach * (1 + 1e-9);
        };
        const bool is_covered = std::any_of(of_edge[e].begin(), of_edge[e].end(), [&](std::size_t p) {
          return covers(circles[p].centre, circles[p].reach) && covers(pieces[p].middle, pieces[p].reach);
        });
        ASSERT_TRUE(is_covered) << "floe " << i << ", edge " << e << " at " << k / 50.0;
      }
      ASSERT_GE(static_cast<double>(of_edge[e].size()) * radius,
                distance(edges.from(e), edges.to(e)) * (1 - 1e-12));
    }
    ASSERT_LE(static_cast<double>(pieces.size()),
              perimeter(polygon) / radius + static_cast<double>(edges.size()));
  }
}

TEST_F(RandomFloes, TheTreesNodesCoverTheirPieces) {
  for (int i = 0; i < 100; ++i) {
    const Boundary boundary = make_boundary(random_floe(random_), {1, i % 2 == 0});
    const Cover& cover = *boundary.cover;
    for (std::size_t n = 0; n < cover.tree.size(); ++n) {
      const CircleNode& node = cover.tree[n];
      for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
        const BoundingCircle& circle = cover.bounding_circles[c];
        ASSERT_LE(distance(node.centre, circle.centre) + circle.reach, node.reach);
      }
      if (node.right == 0) continue;
      ASSERT_EQ(cover.tree[n + 1].count + cover.tree[node.right].count, node.count);
      ASSERT_EQ(cover.tree[n + 1].first, node.first);
      ASSERT_EQ(cover.tree[node.right].first, node.first + cover.tree[n + 1].count);
    }
    ASSERT_EQ(cover.tree.front().count, cover.bounding_circles.size());
  }
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
    NearEdges edges;
    const double bound = near_circles(a, b, a_from_b, margin, circle_pairs);
    edges_of(a, b, circle_pairs, edges);
    const std::vector<NearPair>& edge_pairs = edges.pairs;
    ASSERT_TRUE(std::is_sorted(edge_pairs.begin(), edge_pairs.end()));
    ASSERT_TRUE(std::adjacent_find(edge_pairs.begin(), edge_pairs.end()) == edge_pairs.end());
    const std::set<NearPair> found(edge_pairs.begin(), edge_pairs.end());
    NearEdges by_distance;
    ASSERT_TRUE(have_few_edges(a.edges, b.edges));
    const double bound_by_distance = near_edges(a.edges, b.edges, a_from_b, margin, by_distance);
    ASSERT_TRUE(std::is_sorted(by_distance.pairs.begin(), by_distance.pairs.end()));
    const std::set<NearPair> nearest_found(by_distance.pairs.begin(), by_distance.pairs.end());
    ASSERT_EQ(nearest_found.size(), by_distance.pairs.size());

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
    with_near += !edge_pairs.empty();
    apart += edge_pairs.empty();
    ASSERT_LE(bound, nearest * (1 + 1e-12) + (nearest == 0 ? margin : 0));
    if (edge_pairs.empty()) {
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

}  // namespace
}  // namespace polynya::geometry
