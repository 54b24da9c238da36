#pragma once

#include <vector>

#include "geometry/internal/arrangement.hpp"
#include "geometry/internal/cut_nodes.hpp"
#include "geometry/shape.hpp"

namespace polynya::geometry {

/// The rings of a shape, exact or not, with the nearest doubles of all vertices.
class ShapeRings {
 public:
  explicit ShapeRings(const Shape& shape);

  const Polygon& nearest() const { return shape_.exact ? rounded_ : shape_.polygon; }
  Rings rings() const { return Rings(nearest()); }
  exact::Point point(int ring, int i) const;
  /// Are both ends of the edge doubles?
  bool has_double_ends(EdgeId e) const;
  exact::Polygon exactly() const;

 private:
  bool is_double(int ring, int i) const;

  const Shape& shape_;
  Polygon rounded_;                             // of a shape that is kept exact
  std::vector<std::vector<char>> is_rational_;  // of its vertices: not a double
};

/// A stretch of a ring that the cut leaves as it is: `count` edges from vertex `first` on.
struct FarChain {
  int ring = 0;
  int first = 0;
  int count = 0;
};

/// The edges of a shape that a tool may change or join, and all others as whole stretches. No far edge meets
/// the tool or an edge of another ring, and all ends of far edges are doubles.
struct Window {
  std::vector<EdgeId> near;       ///< in order along the rings
  std::vector<int> chain_after;   ///< of each near edge: the far chain that starts where it ends, or −1
  std::vector<int> chain_before;  ///< and the one that ends where it starts
  std::vector<FarChain> chains;
  std::vector<int> far_rings;  ///< rings without any near edge
};

/// One look at every vertex and, where the shape has holes, at the pairs of edges of different rings whose
/// boxes overlap.
Window open_window(const ShapeRings& shape, const std::vector<exact::SourceSegment>& tool);

}  // namespace polynya::geometry
