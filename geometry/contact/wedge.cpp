#include "geometry/contact/wedge.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::geometry {
namespace {

/// Where the segment from a (inside the circle) to b (outside) leaves it.
Point exit_point(Point a, Point b, Point centre, double radius) {
  const Vector d = b - a;
  const Vector f = a - centre;
  const double qa = dot(d, d);
  const double qb = dot(f, d);
  const double qc = dot(f, f) - radius * radius;
  const double t = (-qb + std::sqrt(std::max(0.0, qb * qb - qa * qc))) / qa;
  return a + t * d;
}

std::uint32_t previous_edge(const EdgeList& edges, std::uint32_t edge) {
  if (edge > 0 && edges.next[edge - 1] == edge) return edge - 1;
  while (edges.next[edge] == edge + 1) ++edge;  // the ring's first edge: its last one leads back to it
  return edge;
}

double angle_between(Vector unit, Vector v) {
  return std::atan2(std::abs(cross(unit, v)), dot(unit, v));
}

}  // namespace

WedgeAngles wedge_angles(const EdgeList& edges, std::uint32_t tip_edge, Point tip, Vector inward, double length) {
  WedgeAngles angles;
  wedge_angles(edges, tip_edge, tip, inward, {&length, 1}, {&angles, 1});
  return angles;
}

void wedge_angles(const EdgeList& edges, std::uint32_t tip_edge, Point tip, Vector inward,
                  std::span<const double> lengths, std::span<WedgeAngles> angles) {
  Point from = tip;
  std::uint32_t e = tip_edge;
  bool is_round = false;  // the whole ring is nearer than the length
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    while (!is_round && distance(tip, edges.to(e)) <= lengths[i]) {
      from = edges.to(e);
      e = edges.next[e];
      is_round = e == tip_edge;
    }
    const Point ahead = is_round && from != tip ? from : exit_point(from, edges.to(e), tip, lengths[i]);
    angles[i].front = angle_between(inward, ahead - tip);
  }

  from = tip;
  e = tip_edge;
  is_round = false;
  for (std::size_t i = 0; i < lengths.size(); ++i) {
    while (!is_round && distance(tip, edges.from(e)) <= lengths[i]) {
      from = edges.from(e);
      e = previous_edge(edges, e);
      is_round = e == tip_edge;
    }
    const Point behind = is_round && from != tip ? from : exit_point(from, edges.from(e), tip, lengths[i]);
    angles[i].back = angle_between(inward, behind - tip);
  }
}

}  // namespace polynya::geometry
