#include "geometry/contact/crack_path.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace polynya::geometry {
namespace {

/// The edges that may cross the line through the point, each once.
std::vector<std::uint32_t> edges_near_line(const Boundary& boundary, Point point, Vector direction) {
  std::vector<std::uint32_t> near;
  if (!boundary.is_ready()) {
    near.resize(boundary.edges.size());
    std::iota(near.begin(), near.end(), 0U);
    return near;
  }
  constexpr double kRounding = 1e-9;  // of the distances, far more than it can be [m]
  const auto is_near = [&](const auto& circle) {
    return std::abs(cross(direction, circle.centre - point)) <= circle.reach + kRounding;
  };
  std::vector<std::uint32_t> nodes{0};
  while (!nodes.empty()) {
    const std::uint32_t index = nodes.back();
    const CircleNode& node = boundary.tree[index];
    nodes.pop_back();
    if (!is_near(node)) continue;
    if (node.right != 0) {
      nodes.push_back(node.right);
      nodes.push_back(index + 1);
      continue;
    }
    for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
      if (!is_near(boundary.bounding_circles[c])) continue;
      std::uint32_t e = boundary.pieces[c].first_edge;
      for (std::uint32_t k = 0; k < boundary.pieces[c].edges; ++k, e = boundary.edges.next[e])
        near.push_back(e);
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

/// Where a line crosses the boundary.
struct LineCrossing {
  double at = 0;  ///< along the line [m]
  std::uint32_t edge = 0;
};

/// The crossings of the line through the point with the boundary, in order.
std::vector<LineCrossing> crossings_of_line(const Boundary& boundary, Point point, Vector direction) {
  const EdgeList& edges = boundary.edges;
  std::vector<LineCrossing> crossings;
  for (const std::uint32_t e : edges_near_line(boundary, point, direction)) {
    const double from = cross(direction, edges.from(e) - point);
    const double to = cross(direction, edges.to(e) - point);
    if ((from > 0) == (to > 0)) continue;
    const double t = from / (from - to);
    crossings.push_back({dot(direction, edges.from(e) + t * (edges.to(e) - edges.from(e)) - point), e});
  }
  std::ranges::stable_sort(crossings, {}, &LineCrossing::at);
  return crossings;
}

}  // namespace

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
    if (enter <= 0) start = enter - margin;  // the point lies in this stretch of ice: begin behind it
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

}  // namespace polynya::geometry
