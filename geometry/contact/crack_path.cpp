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

/// Distances along the line through the point at which it crosses the boundary, in order [m].
std::vector<double> crossings_of_line(const Boundary& boundary, Point point, Vector direction) {
  const EdgeList& edges = boundary.edges;
  std::vector<double> at;
  for (const std::uint32_t e : edges_near_line(boundary, point, direction)) {
    const double from = cross(direction, edges.from(e) - point);
    const double to = cross(direction, edges.to(e) - point);
    if ((from > 0) == (to > 0)) continue;
    const double t = from / (from - to);
    at.push_back(dot(direction, edges.from(e) + t * (edges.to(e) - edges.from(e)) - point));
  }
  std::sort(at.begin(), at.end());
  return at;
}

}  // namespace

CrackPath crack_path(const Boundary& boundary, Point point, Vector direction, double margin) {
  const std::vector<double> at = crossings_of_line(boundary, point, direction);
  CrackPath path{point - margin * direction, point + margin * direction, 0};
  // The line is in ice between crossings 0–1, 2–3, …: an even count, since every ring is closed.
  double start = -margin;
  for (std::size_t i = 0; i + 1 < at.size(); i += 2) {
    if (at[i + 1] <= 0) continue;
    if (at[i] <= 0) start = at[i] - margin;  // the point lies in this stretch of ice: begin behind it
    path.length_in_ice += at[i + 1] - std::max(0.0, at[i]);
    path.end = point + (at[i + 1] + margin) * direction;
  }
  path.start = point + start * direction;
  return path;
}

}  // namespace polynya::geometry
