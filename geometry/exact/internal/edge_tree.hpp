#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// One edge of a polygon, with where it comes from.
struct Edge {
  Point a;
  Point b;
  int ring = 0;   ///< 0 the outer ring, 1 + i hole i
  int index = 0;  ///< the edge starts at this vertex of its ring
};

std::vector<Edge> edges_of(const Polygon& polygon);

inline Box box_of(const Edge& e) {
  return box_around(e.a, e.b);
}

/// Boxes over runs of edges in ring order, halved down to a few edges: edges that follow each other along a
/// ring lie near each other, so no sorting is needed.
class EdgeTree {
 public:
  explicit EdgeTree(const std::vector<Edge>& edges) : edges_(edges) {
    if (!edges.empty()) build(0, edges.size());
  }

  /// Calls visit(i, j), i < j, for every pair of edges whose boxes overlap, until it returns false.
  template <typename Visit>
  bool for_each_pair(Visit visit) const {
    return nodes_.empty() || join_self(0, visit);
  }

  /// Calls visit(i) for every edge whose box overlaps this one, until it returns false.
  template <typename Visit>
  bool for_each_near(const Box& box, Visit visit) const {
    return nodes_.empty() || query(0, box, visit);
  }

 private:
  struct Node {
    Box box;
    std::size_t first, last;
    std::size_t left = 0, right = 0;  ///< children; 0 in a leaf
  };
  static constexpr std::size_t kLeaf = 4;

  std::size_t build(std::size_t first, std::size_t last);

  template <typename Visit>
  bool query(std::size_t n, const Box& box, Visit& visit) const {
    const Node& node = nodes_[n];
    if (!overlaps(node.box, box)) return true;
    if (node.left != 0) return query(node.left, box, visit) && query(node.right, box, visit);
    for (std::size_t i = node.first; i < node.last; ++i) {
      if (overlaps(box_of(edges_[i]), box) && !visit(i)) return false;
    }
    return true;
  }

  template <typename Visit>
  bool join_self(std::size_t n, Visit& visit) const {
    const Node& node = nodes_[n];
    if (node.left == 0) {
      for (std::size_t i = node.first; i < node.last; ++i) {
        for (std::size_t j = i + 1; j < node.last; ++j) {
          if (overlaps(box_of(edges_[i]), box_of(edges_[j])) && !visit(i, j)) return false;
        }
      }
      return true;
    }
    return join_self(node.left, visit) && join_self(node.right, visit) && join(node.left, node.right, visit);
  }

  template <typename Visit>
  bool join(std::size_t m, std::size_t n, Visit& visit) const {
    const Node& low = nodes_[m];
    const Node& high = nodes_[n];
    if (!overlaps(low.box, high.box)) return true;
    if (low.left == 0 && high.left == 0) {
      for (std::size_t i = low.first; i < low.last; ++i) {
        const Box box = box_of(edges_[i]);
        if (!overlaps(box, high.box)) continue;
        for (std::size_t j = high.first; j < high.last; ++j) {
          if (overlaps(box, box_of(edges_[j])) && !visit(i, j)) return false;
        }
      }
      return true;
    }
    const bool split_low =
        high.left == 0 || (low.left != 0 && low.last - low.first >= high.last - high.first);
    if (split_low) return join(low.left, n, visit) && join(low.right, n, visit);
    return join(m, high.left, visit) && join(m, high.right, visit);
  }

  const std::vector<Edge>& edges_;
  std::vector<Node> nodes_;
};

/// Do two different rings of a valid polygon meet in a point? Exact.
bool has_touching_rings(const Polygon& polygon);

}  // namespace polynya::geometry
