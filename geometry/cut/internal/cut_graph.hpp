#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/exact/predicates.hpp"

namespace polynya::geometry {

// The first stages of a local cut: nodes, at which the tool touches or crosses the shape's boundary, and faces, which
// the chains between nodes bound.

/// The place of a point on a ring or polyline: at the vertex `edge`, or inside the edge that starts there.
struct Place {
  int ring = 0;
  int edge = 0;
  bool at_vertex = false;
  friend bool operator==(const Place&, const Place&) = default;
};

/// A point in which the tool touches or crosses the shape's boundary.
struct Node {
  Point at;                 ///< the nearest doubles
  bool is_rounded = false;  ///< true if `at` is not the exact point
  exact::Point exactly_at;  ///< the exact point, if `is_rounded`
  Place on_shape;
  Place on_tool;
  bool is_active = false;  ///< a chord ends here
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

 private:
  const Polygon& polygon_;
};

/// An edge of the shape, by ring and first vertex.
struct EdgeId {
  int ring = 0;
  int index = 0;
};

/// Returns the shape's edges whose boxes overlap the box, by a scan over all vertices.
std::vector<EdgeId> edges_near(const Rings& rings, const Box& box);

/// Returns all points in which the tool touches or crosses the shape's boundary, each once, in order along the shape.
/// Returns nullopt if the shape or the tool passes a point twice (rings that touch each other there); the local cut
/// does not handle that.
std::optional<std::vector<Node>> find_nodes(const Rings& rings, const Tool& tool, const std::vector<EdgeId>& near);

/// Returns the exact point of a node.
exact::Point exact_point(const Node& node);

/// Consecutive vertices between two places of a ring or polyline, without its ends.
struct Run {
  int first = 0;  ///< its first vertex
  int count = 0;  ///< number of vertices; they wrap around the ring
};

/// A directed stretch of boundary between two active nodes, with a face of the cut shape on its left.
struct HalfEdge {
  int from = 0;            ///< node
  int to = 0;              ///< node
  bool is_chord = false;   ///< along the tool through the ice; otherwise along the shape
  bool is_forward = true;  ///< chords are used once in each direction
  int ring = 0;            ///< ring of the shape, if it is no chord
  Run run;                 ///< vertices strictly between the nodes, in the ring's or tool's own order
};

/// A simple closed chain of half-edges.
using Loop = std::vector<int>;

/// One closed walk along a face's boundary, split at the nodes that it visits twice.
struct Walk {
  std::vector<Loop> loops;
  Part part = Part::kOutside;
};

/// The cut as a planar graph of chains: it contains only nodes and chains, no single edges.
struct CutGraph {
  std::vector<HalfEdge> half_edges;  ///< all shape chains, then each chord forward and backward
  std::vector<Walk> walks;
  std::vector<HalfEdge> bridges;  ///< stretches of the tool from ring to ring that separate nothing
  int rings_met = 0;              ///< rings on which chords and bridges end; if several, rings must not touch
  std::vector<char> ring_is_cut;  ///< for each ring of the shape: it has active nodes
  bool is_consistent = true;      ///< false only if the shape or the tool is not valid
  int first_node = -1;            ///< first node along the tool; an open tool may dangle before it
  int last_node = -1;             ///< the last one; an open tool may dangle after it
  bool starts_inside = false;  ///< an open tool reaches its first node through the shape's interior
  bool ends_inside = false;    ///< it leaves its last node into the interior
};

/// Finds which stretches of the tool are chords, and which faces they and the shape's chains bound. Marks active nodes.
CutGraph trace_faces(const Rings& rings, const Tool& tool, std::vector<Node>& nodes);

}  // namespace polynya::geometry
