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
  // Along the boundary one way: `end_of` is the end of an edge that is farther on, `after` the edge beyond it.
  const auto measure = [&](auto end_of, auto after, double WedgeAngles::*angle) {
    Point from = tip;
    std::uint32_t e = tip_edge;
    bool is_round = false;  // the whole ring is nearer than the length
    for (std::size_t i = 0; i < lengths.size(); ++i) {
      const std::uint32_t before = e;
      while (!is_round && distance(tip, end_of(e)) <= lengths[i]) {
        from = end_of(e);
        e = after(e);
        is_round = e == tip_edge;
      }
      const bool is_along_edge = from == tip && e == before;  // chords of one direction
      if (i > 0 && is_along_edge) {
        angles[i].*angle = angles[i - 1].*angle;
        continue;
      }
      const Point at = is_round && from != tip ? from : exit_point(from, end_of(e), tip, lengths[i]);
      angles[i].*angle = angle_between(inward, at - tip);
    }
  };
  measure([&](std::uint32_t e) { return edges.to(e); }, [&](std::uint32_t e) { return edges.next[e]; },
          &WedgeAngles::front);
  measure([&](std::uint32_t e) { return edges.from(e); }, [&](std::uint32_t e) { return previous_edge(edges, e); },
          &WedgeAngles::back);
}

}  // namespace polynya::geometry
