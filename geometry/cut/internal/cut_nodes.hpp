#pragma once

#include <optional>
#include <vector>

#include "geometry/exact/internal/predicates.hpp"
#include "geometry/exact/internal/rational.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Where a point lies on a ring or polyline: at its vertex `edge`, or inside the edge that starts there.
struct Place {
  int ring = 0;
  int edge = 0;
  bool at_vertex = false;
  friend bool operator==(const Place&, const Place&) = default;
};

/// A point in which the tool meets the shape's boundary.
struct Node {
  Point at;                 ///< the nearest doubles
  bool is_rounded = false;  ///< `at` is not the point itself
  exact::Point exactly_at;  ///< the point itself, where `is_rounded`
  Place on_shape;
  Place on_tool;
  bool is_active = false;  ///< a chord ends here
};

/// The cutting tool of a local cut: a simple counter-clockwise ring, or a simple open polyline.
struct Tool {
  const Ring& points;
  bool is_closed = false;

  int edge_count() const { return static_cast<int>(points.size()) - (is_closed ? 0 : 1); }
  Point point(int i) const {
    const int n = static_cast<int>(points.size());
    return points[static_cast<std::size_t>(i < 0 ? i + n : (i >= n ? i - n : i))];
  }
};

/// The rings of a polygon as one list: 0 the outer ring, 1 + i hole i.
struct Rings {
  explicit Rings(const Polygon& polygon) : polygon_(polygon) {}
  int count() const { return static_cast<int>(polygon_.holes.size()) + 1; }
  const Ring& operator[](int i) const {
    return i == 0 ? polygon_.outer : polygon_.holes[static_cast<std::size_t>(i) - 1];
  }
  Point point(int ring, int i) const {
    const Ring& points = (*this)[ring];
    const int n = static_cast<int>(points.size());
    return points[static_cast<std::size_t>(i < 0 ? i + n : (i >= n ? i - n : i))];
  }
  exact::Point exact_point(int ring, int i) const { return exact::exactly(point(ring, i)); }
  const Polygon& polygon() const { return polygon_; }

 private:
  const Polygon& polygon_;
};

/// An edge of the shape, by ring and first vertex.
struct EdgeId {
  int ring = 0;
  int index = 0;
};

/// The shape's edges whose boxes overlap the box: a straight scan over all vertices.
std::vector<EdgeId> edges_near(const Rings& rings, const Box& box);

/// All points in which the tool meets the shape, each once, in order along the shape; none where some point
/// is met twice by the shape or by the tool (rings that touch each other there): the local cut does not cover
/// that.
std::optional<std::vector<Node>> find_nodes(const Rings& rings, const Tool& tool,
                                            const std::vector<EdgeId>& near);

/// The nodes' indices in order along the tool.
std::vector<int> order_along_tool(const std::vector<Node>& nodes, const Tool& tool);

/// The exact point of a node.
exact::Point exact_point(const Node& node);

}  // namespace polynya::geometry
