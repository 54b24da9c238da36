#include "geometry/exact/internal/edge_tree.hpp"

#include "geometry/exact/internal/predicates.hpp"

namespace polynya::geometry {

std::vector<Edge> edges_of(const Polygon& polygon) {
  std::vector<Edge> edges;
  edges.reserve(vertex_count(polygon));
  const auto append = [&edges](const Ring& ring, int ring_index) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      edges.push_back({ring[i], ring[i + 1 == ring.size() ? 0 : i + 1], ring_index, static_cast<int>(i)});
    }
  };
  append(polygon.outer, 0);
  for (std::size_t h = 0; h < polygon.holes.size(); ++h) append(polygon.holes[h], static_cast<int>(h) + 1);
  return edges;
}

std::size_t EdgeTree::build(std::size_t first, std::size_t last) {
  const std::size_t n = nodes_.size();
  nodes_.push_back({{}, first, last});
  Box box = box_of(edges_[first]);
  if (last - first > kLeaf) {
    const std::size_t middle = first + (last - first) / 2;
    const std::size_t left = build(first, middle);
    const std::size_t right = build(middle, last);
    nodes_[n].left = left;
    nodes_[n].right = right;
    box = united(nodes_[left].box, nodes_[right].box);
  } else {
    for (std::size_t i = first + 1; i < last; ++i) extend(box, box_of(edges_[i]));
  }
  nodes_[n].box = box;
  return n;
}

bool has_touching_rings(const Polygon& polygon) {
  if (polygon.holes.empty()) return false;
  const std::vector<Edge> edges = edges_of(polygon);
  return !EdgeTree(edges).for_each_pair([&](std::size_t i, std::size_t j) {
    const Edge& e = edges[i];
    const Edge& f = edges[j];
    return e.ring == f.ring || meet(e.a, e.b, f.a, f.b).kind == Meeting::kNone;
  });
}

}  // namespace polynya::geometry
