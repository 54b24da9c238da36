#include "geometry/contact/crack_path.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace polynya::geometry {

std::vector<LineCrossing> crossings_of_line(const Boundary& boundary, Point point, Vector direction) {
  const EdgeList& edges = boundary.edges;
  std::vector<LineCrossing> crossings;
  constexpr double kRounding = 1e-9;  // of the distances, far more than it can be [m]
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

CrackPath crack_path(const Boundary& boundary, Point point, Vector direction, double margin,
                     CrackReach reach) {
  const std::vector<LineCrossing> crossings = crossings_of_line(boundary, point, direction);
  CrackPath path{point - margin * direction, point + margin * direction, 0, 0, 0};
  // The line is in ice between crossings 0–1, 2–3, …: an even count, since every ring is closed.
  double start = -margin;
  for (std::size_t i = 0; i + 1 < crossings.size(); i += 2) {
    const auto [enter, first_edge] = crossings[i];
    const auto [leave, last_edge] = crossings[i + 1];
    if (leave <= 0) continue;
    // The point lies in this stretch of ice, or in the water before it: begin at its edge.
    if (enter <= 0 || (reach == CrackReach::kFirstEdge && path.length_in_ice == 0)) start = enter - margin;
    if (path.length_in_ice == 0) path.first_edge = first_edge;
    path.last_edge = last_edge;
    path.length_in_ice += leave - std::max(0.0, enter);
    path.end = point + (leave + margin) * direction;
    if (reach == CrackReach::kFirstEdge && boundary.edges.ring[last_edge] == 0) break;
  }
  path.start = point + start * direction;
  return path;
}

CrackSides sides_of_crack(const Boundary& boundary, const CrackPath& path) {
  const EdgeList& edges = boundary.edges;
  if (path.length_in_ice <= 0 || edges.ring[path.first_edge] != 0 || edges.ring[path.last_edge] != 0)
    return {};
  const Vector crack = path.end - path.start;
  const auto crossing = [&](std::uint32_t edge) {
    const Point from = edges.from(edge);
    const Vector along = edges.to(edge) - from;
    return from + (cross(crack, path.start - from) / cross(crack, along)) * along;
  };
  const Point start = crossing(path.first_edge);
  const Point end = crossing(path.last_edge);
  const auto doubled = [&](Point p, Point q) { return cross(p - end, q - end); };
  double all = 0;
  for (std::uint32_t e = 0; e < edges.size() && edges.ring[e] == 0; ++e)
    all += doubled(edges.from(e), edges.to(e));
  // The left side: from the crack's end around the ice, counter-clockwise, to its start.
  double left = 0;
  for (std::uint32_t e = edges.next[path.last_edge]; e != path.first_edge; e = edges.next[e])
    left += doubled(edges.from(e), edges.to(e));
  left += doubled(edges.from(path.first_edge), start);
  return {0.5 * left, 0.5 * (all - left)};
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
