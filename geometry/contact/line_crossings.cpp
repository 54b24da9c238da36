#include "geometry/contact/line_crossings.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

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
  const Cover& cover = *boundary.cover;
  std::vector<std::uint32_t> nodes{0};
  while (!nodes.empty()) {
    const std::uint32_t index = nodes.back();
    const CircleNode& node = cover.tree[index];
    nodes.pop_back();
    if (!is_near(node)) continue;
    if (node.right != 0) {
      nodes.push_back(node.right);
      nodes.push_back(index + 1);
      continue;
    }
    for (std::uint32_t c = node.first; c < node.first + node.count; ++c) {
      if (!is_near(cover.bounding_circles[c])) continue;
      std::uint32_t e = cover.pieces[c].first_edge;
      for (std::uint32_t k = 0; k < cover.pieces[c].edges; ++k, e = boundary.edges.next[e]) near.push_back(e);
    }
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

}  // namespace

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

}  // namespace polynya::geometry
