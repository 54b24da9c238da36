#include "geometry/contact/crack_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "elementary/elementary.hpp"

namespace polynya::geometry {
namespace {

/// Returns the point at which the segment from a (inside the circle) to b (outside) leaves the circle.
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
  while (edges.next[edge] == edge + 1) ++edge;  // back to the ring's last edge, which leads to its first one
  return edge;
}

}  // namespace

WedgeAngles wedge_angles(const EdgeList& edges, const WedgeTip& tip, Vector inward, double length) {
  WedgeAngles angles;
  wedge_angles(edges, tip, inward, {&length, 1}, {&angles, 1});
  return angles;
}

void wedge_angles(const EdgeList& edges, const WedgeTip& wedge_tip, Vector inward, std::span<const double> lengths,
                  std::span<WedgeAngles> angles) {
  const std::uint32_t tip_edge = wedge_tip.edge;  // clang 14 cannot capture structured bindings in a lambda
  const Point tip = wedge_tip.at;
  // Follows the boundary one way: `end_of` is the farther end of an edge, `after` the edge beyond it.
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
      const bool is_along_edge = from == tip && e == before;  // then both chords have one direction
      if (i > 0 && is_along_edge) {
        angles[i].*angle = angles[i - 1].*angle;
        continue;
      }
      const Point at = is_round && from != tip ? from : exit_point(from, end_of(e), tip, lengths[i]);
      angles[i].*angle = elementary::atan2(std::abs(cross(inward, at - tip)), dot(inward, at - tip));
    }
  };
  measure([&](std::uint32_t e) { return edges.to(e); }, [&](std::uint32_t e) { return edges.next[e]; },
          &WedgeAngles::front);
  measure([&](std::uint32_t e) { return edges.from(e); }, [&](std::uint32_t e) { return previous_edge(edges, e); },
          &WedgeAngles::back);
}

std::vector<LineCrossing> crossings_of_line(const Boundary& boundary, Point point, Vector direction) {
  const EdgeList& edges = boundary.edges;
  std::vector<LineCrossing> crossings;
  constexpr double kRounding = 1e-9;  // of the distances, far larger than rounding errors [m]
  const auto is_near = [&](const auto& circle) {
    return std::abs(cross(direction, circle.centre - point)) <= circle.reach + kRounding;
  };
  for_edges(boundary, is_near, [&](std::uint32_t e) {
    const double from = cross(direction, edges.from(e) - point);
    const double to = cross(direction, edges.to(e) - point);
    if ((from > 0) == (to > 0)) return;
    const double t = from / (from - to);
    crossings.push_back({dot(direction, edges.from(e) + t * (edges.to(e) - edges.from(e)) - point), e});
  });
  std::ranges::stable_sort(crossings, {}, &LineCrossing::at);
  return crossings;
}

std::vector<Point> CrackPath::points() const {
  if (knee) return {start, *knee, end};
  return {start, end};
}

CrackPath crack_path(const Boundary& boundary, Point point, Vector direction, double margin, CrackReach reach) {
  const std::vector<LineCrossing> crossings = crossings_of_line(boundary, point, direction);
  CrackPath path{point - margin * direction, point + margin * direction};
  // The line is in ice between crossings 0–1, 2–3, …: their number is even, since every ring is closed.
  double start = -margin;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const auto [enter, first_edge] = crossings[i];
    const auto [leave, last_edge] = crossings[i + 1];
    if (leave <= 0) continue;
    // The point lies in this stretch of ice, or in the water before it: the path begins at the stretch's edge.
    if (enter <= 0 || (reach == CrackReach::kFirstEdge && path.length_in_ice == 0)) start = enter - margin;
    if (path.length_in_ice == 0) path.first_edge = first_edge;
    path.last_edge = last_edge;
    ++path.stretches;
    path.length_in_ice += leave - std::max(0.0, enter);
    path.end = point + (leave + margin) * direction;
    if (reach == CrackReach::kFirstEdge && boundary.edges.ring[last_edge] == 0) break;
  }
  path.start = point + start * direction;
  return path;
}

std::vector<CrackPath> ligaments_of(const Boundary& boundary, Point point, Vector direction, double margin,
                                    const CrackPath& path) {
  const std::vector<LineCrossing> crossings = crossings_of_line(boundary, point, direction);
  const double end = dot(path.end - point, direction);
  std::vector<CrackPath> ligaments;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const auto [enter, first_edge] = crossings[i];
    const auto [leave, last_edge] = crossings[i + 1];
    if (leave <= 0) continue;
    if (enter >= end) break;
    const Point start = ligaments.empty() ? path.start : point + (enter - margin) * direction;
    ligaments.push_back(
        {start, point + (leave + margin) * direction, leave - std::max(0.0, enter), first_edge, last_edge, 1});
  }
  return ligaments;
}

std::optional<CrackPath> turned_path(const Boundary& boundary, const CrackPath& straight, Point first_ice,
                                     const CrackTurn& turn, double margin) {
  const auto [knee, onward] = turn;
  if (straight.stretches != 1 || distance(first_ice, knee) >= straight.length_in_ice) return std::nullopt;
  const CrackPath last_leg = crack_path(boundary, knee, onward, margin, CrackReach::kFirstEdge);
  if (last_leg.stretches != 1) return std::nullopt;
  CrackPath path = straight;
  path.end = last_leg.end;
  path.last_edge = last_leg.last_edge;
  path.length_in_ice = distance(first_ice, knee) + last_leg.length_in_ice;
  path.knee = knee;
  return path;
}

CrackSides sides_of_crack(const Boundary& boundary, const CrackPath& path) {
  const EdgeList& edges = boundary.edges;
  if (path.length_in_ice <= 0 || edges.ring[path.first_edge] != 0 || edges.ring[path.last_edge] != 0) return {};
  const auto crossing = [&](std::uint32_t edge, Point leg_from, Point leg_to) {
    const Vector leg = leg_to - leg_from;
    const Point from = edges.from(edge);
    const Vector along = edges.to(edge) - from;
    return from + (cross(leg, leg_from - from) / cross(leg, along)) * along;
  };
  const Point start = crossing(path.first_edge, path.start, path.knee.value_or(path.end));
  const Point end = crossing(path.last_edge, path.knee.value_or(path.start), path.end);
  const auto doubled = [&](Point p, Point q) { return cross(p - end, q - end); };
  double all = 0;
  for (std::uint32_t e = 0; e < edges.size() && edges.ring[e] == 0; ++e) all += doubled(edges.from(e), edges.to(e));
  // The left side lies from the crack's end around the ice, counter-clockwise, to its start.
  double left = 0;
  for (std::uint32_t e = edges.next[path.last_edge]; e != path.first_edge; e = edges.next[e])
    left += doubled(edges.from(e), edges.to(e));
  left += doubled(edges.from(path.first_edge), start);
  if (path.knee) left += doubled(start, *path.knee);
  return {0.5 * left, 0.5 * (all - left)};
}

std::optional<Arm> arm_beside(const Boundary& boundary, Point first_ice, Vector direction, double share) {
  constexpr int kMostSteps = 20;      // each makes the width accurate to about a tenth where the edge is uneven
  constexpr double kAccuracy = 1e-3;  // of the width
  const Vector across = perpendicular(direction);
  const auto nearest_at = [&](double along) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const LineCrossing& crossing : crossings_of_line(boundary, first_ice + along * direction, across))
      if (std::abs(crossing.at) < std::abs(nearest)) nearest = crossing.at;
    return nearest;
  };
  double along = 1e-3;  // a little inside the ice
  for (int step = 0; step < kMostSteps; ++step) {
    const double nearest = nearest_at(along);
    if (!std::isfinite(nearest)) return std::nullopt;
    const double width = std::abs(nearest);
    if (std::abs(share * width - along) <= kAccuracy * width) return Arm{width, nearest > 0};
    along = share * width;
  }
  return std::nullopt;
}

Passage passage_through(const Boundary& body, Point point, Vector direction) {
  constexpr double kRounding = 1e-6;  // of the place where two boundaries cross [m]
  Passage passage{0, 0, std::numeric_limits<double>::infinity()};
  const std::vector<LineCrossing> crossings = crossings_of_line(body, point, direction);
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const double enter = crossings[i].at;
    const double leave = crossings[i + 1].at;
    if (leave <= kRounding || leave - enter <= kRounding) continue;
    if (enter > passage.ahead + kRounding) {
      passage.again = enter;
      break;
    }
    if (passage.ahead == 0) passage.behind = std::min(0.0, enter);
    passage.ahead = leave;
  }
  return passage;
}

double crack_width(const Boundary& boundary, const CrackPath& path, double share_of_way) {
  const Vector way = path.end - path.start;
  const Vector across = perpendicular(way) / length(way);
  double nearest = std::numeric_limits<double>::infinity();
  for (const LineCrossing& crossing : crossings_of_line(boundary, path.start + share_of_way * way, across))
    nearest = std::min(nearest, std::abs(crossing.at));
  return std::isfinite(nearest) ? 2 * nearest : 0;
}

}  // namespace polynya::geometry
