#include <algorithm>
#include <cmath>

#include "geometry/contact/boundary.hpp"
#include "geometry/exact/point_in_ring.hpp"

namespace polynya::geometry {
namespace {

struct EdgeEnds {
  Point from, to;
};

/// Which side of an edge a point is on: > 0 left, < 0 right.
double side_of(const EdgeEnds& edge, Point p) {
  return cross(edge.to - edge.from, p - edge.from);
}

bool do_meet(const EdgeEnds& p, const EdgeEnds& q) {
  if (!overlaps(box_around(p.from, p.to), box_around(q.from, q.to))) return false;
  const double p_from = side_of(q, p.from), p_to = side_of(q, p.to);
  if ((p_from > 0 && p_to > 0) || (p_from < 0 && p_to < 0)) return false;
  const double q_from = side_of(p, q.from), q_to = side_of(p, q.to);
  return !((q_from > 0 && q_to > 0) || (q_from < 0 && q_to < 0));
}

/// Far more than what circles miss of their edges by rounding [m]. Without it an edge may be overlooked, and
/// bodies that overlap are clear; larger only costs time.
constexpr double kSlack = 1e-6;

/// As is_inside of all edges: no other edge is to the right of the point.
bool is_inside_boundary(const Boundary& boundary, Point p) {
  const auto is_to_the_right = [&](const BoundingCircle& circle) {
    const double reach = circle.reach + kSlack;
    return std::abs(circle.centre.y - p.y) <= reach && circle.centre.x + reach >= p.x;
  };
  bool inside = false;
  for_edges(boundary, is_to_the_right, [&](std::uint32_t edge) {
    if (crosses_ray(boundary.edges.from(edge), boundary.edges.to(edge), p)) inside = !inside;
  });
  return inside;
}

/// Whether an edge of a meets one of b, which is within the box, in a's frame.
bool do_edges_meet(const Boundary& a, const EdgeList& b, const Ring& b_in_a, const Box& box_of_b) {
  const Point centre = midpoint(box_of_b.low, box_of_b.high);
  const double radius = distance(centre, box_of_b.high) + kSlack;
  bool meets = false;
  const auto is_near = [&](const BoundingCircle& circle) {
    return !meets && distance(circle.centre, centre) <= circle.reach + radius;
  };
  for_edges(a, is_near, [&](std::uint32_t edge) {
    const EdgeEnds p{a.edges.from(edge), a.edges.to(edge)};
    if (meets || !overlaps(box_of_b, box_around(p.from, p.to))) return;
    for (std::uint32_t j = 0; j < b.size() && !meets; ++j) meets = do_meet(p, {b_in_a[j], b_in_a[b.next[j]]});
  });
  return meets;
}

}  // namespace

bool is_clear(const Boundary& a, const Boundary& b, const Pose& a_from_b) {
  Ring b_in_a;
  b_in_a.reserve(b.edges.size());
  for (const Point p : b.edges.vertices) b_in_a.push_back(transform(a_from_b, p));
  if (do_edges_meet(a, b.edges, b_in_a, bounding_box(b_in_a))) return false;
  // Where no edges meet, one vertex stands for all of its body.
  return !is_inside_boundary(a, b_in_a.front()) &&
         !is_inside(b.edges, inverse_transform(a_from_b, a.edges.vertices.front()));
}

}  // namespace polynya::geometry
