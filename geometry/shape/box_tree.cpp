#include "geometry/shape/box_tree.hpp"

#include <algorithm>
#include <numeric>

namespace polynya::geometry {
namespace {

std::vector<Box> boxes_of(const std::vector<Edge>& edges) {
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (const Edge& edge : edges) boxes.push_back(box_of(edge));
  return boxes;
}

}  // namespace

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

BoxTree::BoxTree(const std::vector<Edge>& edges) : BoxTree(boxes_of(edges), Order::kAlongRing) {}

BoxTree::BoxTree(std::vector<Box> boxes, Order order) : boxes_(std::move(boxes)) {
  if (boxes_.empty()) return;
  const auto count = static_cast<std::uint32_t>(boxes_.size());
  if (order == Order::kInPlace) {
    numbers_.resize(count);
    std::iota(numbers_.begin(), numbers_.end(), 0U);
    sort_in_place(0, count);
    std::vector<Box> sorted;
    sorted.reserve(count);
    for (const std::uint32_t i : numbers_) sorted.push_back(boxes_[i]);
    boxes_ = std::move(sorted);
  }
  nodes_.reserve(2 * (count / (kLeaf / 2) + 1));
  build(0, count);
}

void BoxTree::sort_in_place(std::uint32_t first, std::uint32_t last) {
  if (last - first <= kLeaf) return;
  const auto middle_of = [this](std::uint32_t i) { return midpoint(boxes_[i].low, boxes_[i].high); };
  Box middles{middle_of(numbers_[first]), middle_of(numbers_[first])};
  for (std::uint32_t i = first; i < last; ++i) extend(middles, middle_of(numbers_[i]));
  const bool is_wide = middles.high.x - middles.low.x > middles.high.y - middles.low.y;
  const std::uint32_t half = first + (last - first) / 2;
  const auto at = [this](std::uint32_t i) { return numbers_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(at(first), at(half), at(last), [&](std::uint32_t i, std::uint32_t j) {
    return is_wide ? middle_of(i).x < middle_of(j).x : middle_of(i).y < middle_of(j).y;
  });
  sort_in_place(first, half);
  sort_in_place(half, last);
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
  BoxTree(boxes, BoxTree::Order::kInPlace).for_each_pair([&](std::size_t i, std::size_t j) {
    pairs.emplace_back(i, j);
    return true;
  });
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace polynya::geometry
