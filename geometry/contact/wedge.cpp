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
  Point from = tip;
  std::uint32_t e = tip_edge;
  while (distance(tip, edges.to(e)) <= length) {
    from = edges.to(e);
    e = edges.next[e];
    if (e == tip_edge) break;  // the whole ring is nearer than that
  }
  const Point ahead = e == tip_edge && from != tip ? from : exit_point(from, edges.to(e), tip, length);

  from = tip;
  e = tip_edge;
  while (distance(tip, edges.from(e)) <= length) {
    from = edges.from(e);
    e = previous_edge(edges, e);
    if (e == tip_edge) break;
  }
  const Point behind = e == tip_edge && from != tip ? from : exit_point(from, edges.from(e), tip, length);
  return {angle_between(inward, ahead - tip), angle_between(inward, behind - tip)};
}

}  // namespace polynya::geometry
