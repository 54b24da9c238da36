#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// All boundaries of a polygon as one flat list of edges, rings one after the other, the outer one first.
/// Edge i runs from vertices[i] to vertices[next[i]], with the interior on its left.
struct EdgeList {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> next;
  std::vector<std::uint32_t> ring;  ///< 0 for the outer ring, then the holes

  std::size_t size() const { return vertices.size(); }
  bool has_holes() const { return ring.back() > 0; }
  std::span<const Point> outer_corners() const {
    return std::span(vertices).first(static_cast<std::size_t>(std::ranges::upper_bound(ring, 0U) - ring.begin()));
  }
  Point from(std::uint32_t edge) const { return vertices[edge]; }
  Point to(std::uint32_t edge) const { return vertices[next[edge]]; }
};

EdgeList edge_list(const Polygon& polygon);

/// The edges that a piece of boundary lies on.
struct PieceEdges {
  std::uint32_t first_edge = 0;
  std::uint32_t edges = 1;  ///< this many in all, the next ones of the same ring
};

/// A piece of boundary with one contact circle: a part of one long edge, or some short edges in a row.
struct BoundaryPiece : PieceEdges {
  Point middle;                   ///< half-way along it, on the boundary, in the body frame [m]
  double reach = 0;               ///< no point of it is farther from the middle [m]
  std::uint32_t middle_edge = 0;  ///< the edge that the middle is on
};

/// All boundaries of a polygon in pieces, in ring order, one per `radius` of boundary or less, but no more
/// than `most` of them on one edge.
std::vector<BoundaryPiece> boundary_pieces(const EdgeList& edges, double radius,
                                           double most = std::numeric_limits<double>::infinity());

/// A circle that touches the boundary from inside at the middle of its piece.
struct ContactCircle {
  Point centre;       ///< in the body frame [m]
  double radius = 0;  ///< at most the setting's; smaller where the ice is too narrow for it [m]
  double reach = 0;   ///< no point of its piece of boundary is farther from the centre [m]
};

/// The contact circles of the pieces of a polygon's boundaries, one each.
/// [Sawamura2017] sets them along waterline and floe edges with a radius of 1.0 m.
/// Deviation: a circle never leaves the ice. Near corners and in narrow places it shrinks until it touches
/// the boundary twice, so the circles' union tends to the polygon as the radius tends to zero.
std::vector<ContactCircle> sample_contact_circles(const EdgeList& edges, const std::vector<BoundaryPiece>& pieces,
                                                  double radius);

/// A circle that holds a piece of boundary.
struct BoundingCircle {
  Point centre;      ///< [m]
  double reach = 0;  ///< [m]
};

/// A node of the tree over a boundary's bounding circles: a circle around all of its own.
struct CircleNode {
  Point centre;             ///< [m]
  double reach = 0;         ///< [m]
  std::uint32_t first = 0;  ///< first bounding circle
  std::uint32_t count = 0;  ///< number of bounding circles; children split them in halves
  std::uint32_t right = 0;  ///< index of the second child, the first is the next node; 0 at a leaf
};

/// Which circles a boundary has.
struct CircleRule {
  double circle_radius = 1.0;  ///< of contact circles, and the most length of a piece [m]
  bool has_circles = false;    ///< contact circles, for find_circle_manifolds: bounding circles then share
                               ///< their centres; without, they stand on the boundary and are tighter
};

/// What finds the parts of two boundaries that are near each other: pieces of one, their bounding circles and
/// a tree over these, in the body frame. It follows from the edges, and takes far more memory than they.
struct Cover {
  std::vector<PieceEdges> pieces;
  std::vector<ContactCircle> circles;            ///< of the pieces; empty where the rule has none
  std::vector<BoundingCircle> bounding_circles;  ///< of the pieces, about contact circles' centres or middles
  std::vector<CircleNode> tree;
};

/// Makes the cover of a boundary, in the memory of the one that was there.
void make_cover(const EdgeList& edges, const CircleRule& rule, Cover& cover);

/// About how many pieces the boundary has.
double pieces_of(const EdgeList& edges, double circle_radius);

/// A body's boundary: its edges, in the body frame, and its cover where that is kept.
struct Boundary {
  EdgeList edges;
  std::shared_ptr<const Cover> cover;

  bool is_ready() const { return cover != nullptr; }
};

/// A boundary with its cover, ready for finding contacts, wherever that is kept.
struct Covered {
  Covered(const EdgeList& edges_of_it, const Cover& cover_of_it) : edges(edges_of_it), cover(cover_of_it) {}
  Covered(const Boundary& ready) : edges(ready.edges), cover(*ready.cover) {}  // NOLINT: it is one
  const EdgeList& edges;
  const Cover& cover;
};

/// A boundary with edges only: enough for a floe that no body comes near.
Boundary make_outline(const Polygon& polygon);

/// Makes a boundary's cover, and keeps it.
void make_ready(Boundary& boundary, const CircleRule& rule);

/// A pair of edges (or of bounding circles) of two boundaries that are near each other.
struct NearPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// Pairs of edges that are near each other, with the edges' ends beside them: each in its boundary's frame.
struct NearEdges {
  std::vector<NearPair> pairs;
  /// Eight columns of `stride` numbers: x and y of the first end of a's edges, of the second, and of b's [m].
  std::vector<double> ends;
  std::size_t stride = 0;  ///< at least one for each pair, a multiple of 4
};

/// All pairs of bounding circles of two boundaries within `margin` of each other [m], and so all near pieces.
/// Appends to `circle_pairs`. Returns a lower bound of the distance between the boundaries [m], of use where
/// nothing is within the margin.
double near_circles(const Covered& a, const Covered& b, const Pose& a_from_b, double margin,
                    std::vector<NearPair>& circle_pairs);

/// Edges of two boundaries together, which near_edges() compares without a tree [-]. Its stack holds that
/// many points: more costs their product, fewer makes covers for bodies that do not need them.
inline constexpr std::size_t kFewEdges = 256;
inline bool have_few_edges(const EdgeList& a, const EdgeList& b) {
  return a.size() + b.size() <= kFewEdges;
}

/// The pairs of edges of two boundaries of few edges (have_few_edges) within `margin` of each other [m], in order.
/// Returns a lower bound of the distance between the boundaries [m], of use where nothing is within the margin.
double near_edges(const EdgeList& a, const EdgeList& b, const Pose& a_from_b, double margin, NearEdges& edges);

/// The pairs of edges on the pieces of pairs of bounding circles, each once, in order.
void edges_of(const Covered& a, const Covered& b, const std::vector<NearPair>& circle_pairs, NearEdges& edges);

/// Calls use(edge), in order and once, for each edge that has a bounding circle of which matters(circle), and
/// maybe for others; for all edges of a boundary that is not ready. `matters` holds for a circle where it
/// holds for one within it.
template <class Matters, class Use>
void for_edges(const Boundary& boundary, Matters matters, Use use) {
  if (!boundary.is_ready()) {
    for (std::uint32_t edge = 0; edge < boundary.edges.size(); ++edge) use(edge);
    return;
  }
  const Cover& cover = *boundary.cover;
  std::uint32_t next = 0;  // a long edge has several pieces and is used once
  const auto search = [&](const auto& self, std::uint32_t index) -> void {
    const CircleNode& node = cover.tree[index];
    if (!matters(BoundingCircle{node.centre, node.reach})) return;
    if (node.right != 0) {
      self(self, index + 1);
      return self(self, node.right);
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      if (!matters(cover.bounding_circles[i])) continue;
      const PieceEdges& piece = cover.pieces[i];
      const std::uint32_t end = piece.first_edge + piece.edges;
      for (next = std::max(next, piece.first_edge); next < end; ++next) use(next);
    }
  };
  search(search, 0);
}

/// Whether a point is inside and not in a hole. Exact.
bool is_inside(const EdgeList& edges, Point p);

/// Whether boundaries that do not cross are one inside the other.
bool is_one_inside(const EdgeList& a, const EdgeList& b, const Pose& a_from_b);
bool is_one_inside(const Covered& a, const Covered& b, const Pose& a_from_b);

/// Least distance between the edges of the pairs, 0 where two cross or touch [m].
double least_distance(const Pose& a_from_b, const NearEdges& edges);

/// Whether two bodies share nothing, in plain doubles: no edges cross or touch, and neither is inside the
/// other. A boundary's edges suffice, it need not be ready. Of a's edges only those in the box of b are
/// compared with b's: b is best the smaller. Within rounding of a touch the answer may be either.
bool is_clear(const Boundary& a, const Boundary& b, const Pose& a_from_b);

}  // namespace polynya::geometry
