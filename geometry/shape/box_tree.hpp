#pragma once

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// One edge of a polygon, with its ring and its place in the ring.
struct Edge {
  Point a;
  Point b;
  int ring = 0;   ///< 0: the outer ring; 1 + i: hole i
  int index = 0;  ///< the edge starts at this vertex of its ring
};

std::vector<Edge> edges_of(const Polygon& polygon);

inline Box box_of(const Edge& e) {
  return box_around(e.a, e.b);
}

/// Returns the boxes of items, in their order.
template <class Items, class BoxOf>
std::vector<Box> boxes_of(const Items& items, BoxOf box_of_item) {
  std::vector<Box> boxes;
  boxes.reserve(items.size());
  for (const auto& item : items) boxes.push_back(box_of_item(item));
  return boxes;
}

/// A search tree for edges or other items that are given in a row in one frame. It has boxes over runs of items, halved
/// down to a few. Items are not sorted, since consecutive edges of a ring lie near each other. Boxes that touch count
/// as overlapping. (Bodies and places are searched in grids: dynamics/contact/hash_grid.hpp, power_diagram.cpp.
/// Boundaries in two rotated frames are searched by circles: contact/boundary.hpp.)
class BoxTree {
 public:
  explicit BoxTree(std::vector<Box> boxes);
  template <class Item>
  explicit BoxTree(const std::vector<Item>& items)
      : BoxTree(boxes_of(items, [](const Item& item) { return box_of(item); })) {}

  /// Calls visit(i, j), i < j, for every pair of boxes that overlap, until it returns false.
  template <typename Visit>
  bool for_each_pair(Visit visit) const {
    return nodes_.empty() || join_self(0, visit);
  }

  /// Calls visit(i) for every box that overlaps this one, i ascending, until it returns false.
  template <typename Visit>
  bool for_each_near(const Box& box, Visit visit) const {
    return nodes_.empty() || query(0, box, visit);
  }

 private:
  struct Node {
    Box box;
    std::uint32_t first, last;
    std::uint32_t left = 0, right = 0;  ///< children; 0 in a leaf
  };
  /// Number of boxes in a leaf. More: pairs in a leaf cost its square. Fewer: the tree has more nodes. 3 to 8 take the
  /// same time.
  static constexpr std::uint32_t kLeaf = 4;

  std::uint32_t build(std::uint32_t first, std::uint32_t last);

  template <typename Visit>
  bool query(std::uint32_t n, const Box& box, Visit& visit) const {
    const Node& node = nodes_[n];
    if (!overlaps(node.box, box)) return true;
    if (node.left != 0) return query(node.left, box, visit) && query(node.right, box, visit);
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      if (overlaps(boxes_[i], box) && !visit(std::size_t{i})) return false;
    }
    return true;
  }

  template <typename Visit>
  bool join_self(std::uint32_t n, Visit& visit) const {
    const Node& node = nodes_[n];
    if (node.left != 0)
      return join_self(node.left, visit) && join_self(node.right, visit) && join(node.left, node.right, visit);
    for (std::uint32_t i = node.first; i < node.last; ++i) {
      for (std::uint32_t j = i + 1; j < node.last; ++j) {
        if (overlaps(boxes_[i], boxes_[j]) && !visit(std::size_t{i}, std::size_t{j})) return false;
      }
    }
    return true;
  }

  template <typename Visit>
  bool join(std::uint32_t m, std::uint32_t n, Visit& visit) const {
    const Node& low = nodes_[m];
    const Node& high = nodes_[n];
    if (!overlaps(low.box, high.box)) return true;
    if (low.left == 0 && high.left == 0) {
      for (std::uint32_t i = low.first; i < low.last; ++i) {
        if (!overlaps(boxes_[i], high.box)) continue;
        for (std::uint32_t j = high.first; j < high.last; ++j) {
          if (overlaps(boxes_[i], boxes_[j]) && !visit(std::size_t{i}, std::size_t{j})) return false;
        }
      }
      return true;
    }
    const bool split_low = high.left == 0 || (low.left != 0 && low.last - low.first >= high.last - high.first);
    if (split_low) return join(low.left, n, visit) && join(low.right, n, visit);
    return join(m, high.left, visit) && join(m, high.right, visit);
  }

  std::vector<Box> boxes_;
  std::vector<Node> nodes_;
};

/// Returns the pairs of boxes that overlap, by their indices: the lower one first, in ascending order. For boxes in any
/// order; they are swept along the longer side of their common box.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of_boxes(const std::vector<Box>& boxes);

}  // namespace polynya::geometry
