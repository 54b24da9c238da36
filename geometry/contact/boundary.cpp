#include "geometry/contact/boundary.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "geometry/exact/point_in_ring.hpp"

namespace polynya::geometry {
namespace {

/// Bounding circles of a leaf. More are compared one by one, fewer make a larger tree.
constexpr std::uint32_t kLeafCircles = 4;
/// Pieces of an edge: every metre of a ship's side, not of a plate's. More take memory, 64 bytes each; fewer
/// make more of a long edge near, and contacts slower.
constexpr double kMostPieces = 128;

/// Centres and radii of some bounding circles.
struct Extent {
  Box centres;
  double reach = 0;  ///< the largest
};

/// The least reach of a leaf that covers its circles, or of another node that covers its children's.
double covering_reach(const Cover& cover, std::size_t index, const CircleNode& node) {
  double reach = 0;
  const auto include = [&](const auto& circle) {
    reach = std::max(reach, distance(node.centre, circle.centre) + circle.reach);
  };
  if (node.right == 0) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) include(cover.bounding_circles[i]);
  } else {
    include(cover.tree[index + 1]);
    include(cover.tree[node.right]);
  }
  return reach;
}

/// Builds the node over bounding circles [first, first + count) and everything below it.
Extent build_node(Cover& cover, std::uint32_t first, std::uint32_t count) {
  const std::size_t index = cover.tree.size();
  cover.tree.push_back({});
  CircleNode node{{}, 0, first, count, 0};
  Extent extent{{cover.bounding_circles[first].centre, cover.bounding_circles[first].centre}, 0};
  if (count > kLeafCircles) {
    extent = build_node(cover, first, count / 2);
    node.right = static_cast<std::uint32_t>(cover.tree.size());
    const Extent other = build_node(cover, first + count / 2, count - count / 2);
    extend(extent.centres, other.centres);
    extent.reach = std::max(extent.reach, other.reach);
  } else {
    for (std::uint32_t i = first; i < first + count; ++i) {
      extend(extent.centres, cover.bounding_circles[i].centre);
      extent.reach = std::max(extent.reach, cover.bounding_circles[i].reach);
    }
  }
  node.centre = midpoint(extent.centres.low, extent.centres.high);
  node.reach = std::min(covering_reach(cover, index, node), distance(node.centre, extent.centres.high) + extent.reach);
  node.reach *= 1 + 1e-12;
  cover.tree[index] = node;
  return extent;
}

double gap(const CircleNode& a, const CircleNode& b, Point b_centre_in_a) {
  return distance(a.centre, b_centre_in_a) - a.reach - b.reach;
}

}  // namespace

bool is_inside(const EdgeList& edges, Point p) {
  bool inside = false;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    if (crosses_ray(edges.from(edge), edges.to(edge), p)) inside = !inside;
  }
  return inside;
}

Boundary make_outline(const Polygon& polygon) {
  Boundary boundary;
  boundary.edges = edge_list(polygon);
  return boundary;
}

double pieces_of(const EdgeList& edges, double circle_radius) {
  double length = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) length += distance(edges.from(e), edges.to(e));
  return 1 + length / circle_radius;
}

void make_cover(const EdgeList& edges, const CircleRule& rule, Cover& cover) {
  // Contact circles have their size; what only bounds may be coarse where a plate's rim is long and straight.
  const std::vector<BoundaryPiece> pieces = rule.has_circles ? boundary_pieces(edges, rule.circle_radius)
                                                             : boundary_pieces(edges, rule.circle_radius, kMostPieces);
  cover.pieces.clear();
  cover.pieces.reserve(pieces.size());
  for (const BoundaryPiece& piece : pieces) cover.pieces.push_back({piece.first_edge, piece.edges});
  cover.bounding_circles.clear();
  cover.bounding_circles.reserve(pieces.size());
  if (rule.has_circles) {
    cover.circles = sample_contact_circles(edges, pieces, rule.circle_radius);
    for (const ContactCircle& circle : cover.circles) cover.bounding_circles.push_back({circle.centre, circle.reach});
  } else {
    for (const BoundaryPiece& piece : pieces) cover.bounding_circles.push_back({piece.middle, piece.reach});
  }
  cover.tree.clear();
  cover.tree.reserve(pieces.size());
  build_node(cover, 0, static_cast<std::uint32_t>(pieces.size()));
}

void make_ready(Boundary& boundary, const CircleRule& rule) {
  auto cover = std::make_shared<Cover>();
  make_cover(boundary.edges, rule, *cover);
  cover->tree.shrink_to_fit();
  boundary.cover = std::move(cover);
}

Boundary make_boundary(const Polygon& polygon, const CircleRule& rule) {
  Boundary boundary = make_outline(polygon);
  make_ready(boundary, rule);
  return boundary;
}

double near_circles(const Covered& a, const Covered& b, const Pose& a_from_b, double margin,
                    std::vector<NearPair>& circle_pairs) {
  double bound = std::numeric_limits<double>::infinity();
  const std::size_t before = circle_pairs.size();
  NearPair stack[128];  // depth of both trees: a boundary of 2^60 circles would fit
  int top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const NearPair pair = stack[--top];
    const CircleNode& na = a.cover.tree[pair.a];
    const CircleNode& nb = b.cover.tree[pair.b];
    const double d = gap(na, nb, transform(a_from_b, nb.centre));
    if (d > margin) {
      bound = std::min(bound, d);
      continue;
    }
    if (na.right == 0 && nb.right == 0) {
      for (std::uint32_t k = nb.first; k < nb.first + nb.count; ++k) {
        const BoundingCircle& of_b = b.cover.bounding_circles[k];
        const Point centre = transform(a_from_b, of_b.centre);
        for (std::uint32_t i = na.first; i < na.first + na.count; ++i) {
          const BoundingCircle& of_a = a.cover.bounding_circles[i];
          const double reaches = of_a.reach + of_b.reach;
          const double squared = squared_length(centre - of_a.centre);
          if (squared <= (reaches + margin) * (reaches + margin))
            circle_pairs.push_back({i, k});
          else if (circle_pairs.size() == before)
            bound = std::min(bound, std::sqrt(squared) - reaches);
        }
      }
    } else if (nb.right == 0 || (na.right != 0 && na.reach >= nb.reach)) {
      stack[top++] = {na.right, pair.b};
      stack[top++] = {pair.a + 1, pair.b};
    } else {
      stack[top++] = {pair.a, nb.right};
      stack[top++] = {pair.a, pair.b + 1};
    }
  }
  return circle_pairs.size() == before ? bound : 0;
}

bool is_one_inside(const Covered& a, const Covered& b, const Pose& a_from_b) {
  const CircleNode& around_a = a.cover.tree.front();
  const CircleNode& around_b = b.cover.tree.front();
  const double between = distance(around_a.centre, transform(a_from_b, around_b.centre));
  if (between > std::max(around_a.reach, around_b.reach)) return false;
  return is_one_inside(a.edges, b.edges, a_from_b);
}

bool is_one_inside(const EdgeList& a, const EdgeList& b, const Pose& a_from_b) {
  // All vertices: where two only touch, rounding may find one of them inside.
  return std::ranges::all_of(b.vertices, [&](Point p) { return is_inside(a, transform(a_from_b, p)); }) ||
         std::ranges::all_of(a.vertices, [&](Point p) { return is_inside(b, inverse_transform(a_from_b, p)); });
}

}  // namespace polynya::geometry
