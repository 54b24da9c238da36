#include "geometry/shape/box_tree.hpp"

#include <algorithm>
#include <numeric>

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

BoxTree::BoxTree(std::vector<Box> boxes) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  nodes_.reserve(2 * (boxes_.size() / (kLeaf / 2) + 1));
  build(0, count);
}

std::uint32_t BoxTree::build(std::uint32_t first, std::uint32_t last) {
  const auto n = static_cast<std::uint32_t>(nodes_.size());
  nodes_.push_back({boxes_[first], first, last});
  Box box = boxes_[first];
  if (last - first > kLeaf) {
    const std::uint32_t middle = first + (last - first) / 2;
    const std::uint32_t left = build(first, middle);
    const std::uint32_t right = build(middle, last);
    nodes_[n].left = left;
    nodes_[n].right = right;
    box = united(nodes_[left].box, nodes_[right].box);
  } else {
    for (std::uint32_t i = first + 1; i < last; ++i) extend(box, boxes_[i]);
  }
  nodes_[n].box = box;
  return n;
}

std::vector<std::pair<std::size_t, std::size_t>> pairs_of_boxes(const std::vector<Box>& boxes) {
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  if (boxes.empty()) return pairs;
  Box all = boxes.front();
  for (const Box& box : boxes) extend(all, box);
  double Point::*const along = all.high.x - all.low.x > all.high.y - all.low.y ? &Point::x : &Point::y;
  std::vector<std::size_t> order(boxes.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::sort(order, {}, [&](std::size_t i) { return boxes[i].low.*along; });
  std::vector<Box> swept;
  swept.reserve(boxes.size());
  for (const std::size_t i : order) swept.push_back(boxes[i]);
  for (std::size_t k = 0; k < swept.size(); ++k) {
    for (std::size_t l = k + 1; l < swept.size() && swept[l].low.*along <= swept[k].high.*along; ++l) {
      if (overlaps(swept[k], swept[l])) pairs.push_back(std::minmax(order[k], order[l]));
    }
  }
  std::ranges::sort(pairs);
  return pairs;
}

}  // namespace polynya::geometry
