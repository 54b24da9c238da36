#include "geometry/contact/clearance.hpp"

namespace polynya::geometry {
namespace {

struct Edge {
  Point from, to;
};

/// Which side of an edge a point is on: > 0 left, < 0 right.
double side_of(const Edge& edge, Point p) {
  return cross(edge.to - edge.from, p - edge.from);
}

bool do_meet(const Edge& p, const Edge& q) {
  if (!overlaps(box_around(p.from, p.to), box_around(q.from, q.to))) return false;
  const double p_from = side_of(q, p.from), p_to = side_of(q, p.to);
  if ((p_from > 0 && p_to > 0) || (p_from < 0 && p_to < 0)) return false;
  const double q_from = side_of(p, q.from), q_to = side_of(p, q.to);
  return !((q_from > 0 && q_to > 0) || (q_from < 0 && q_to < 0));
}

}  // namespace

bool is_clear(const Boundary& a, const Boundary& b, const Pose& a_from_b) {
  Ring b_in_a;
  b_in_a.reserve(b.edges.size());
  for (const Point p : b.edges.vertices) b_in_a.push_back(transform(a_from_b, p));
  const Box box_of_b = bounding_box(b_in_a);
  for (std::uint32_t i = 0; i < a.edges.size(); ++i) {
    const Edge p{a.edges.from(i), a.edges.to(i)};
    if (!overlaps(box_of_b, box_around(p.from, p.to))) continue;
    for (std::uint32_t j = 0; j < b.edges.size(); ++j) {
      if (do_meet(p, {b_in_a[j], b_in_a[b.edges.next[j]]})) return false;
    }
  }
  // Where no edges meet, one vertex stands for all of its body.
  return !is_inside(a.edges, b_in_a.front()) &&
         !is_inside(b.edges, inverse_transform(a_from_b, a.edges.vertices.front()));
}

}  // namespace polynya::geometry
