#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// All boundaries of a polygon as one flat list of edges, ring by ring, the outer ring first. Edge i runs from
/// vertices[i] to vertices[next[i]], with the interior on its left.
struct EdgeList {
  std::vector<Point> vertices;
  std::vector<std::uint32_t> next;
  std::vector<std::uint32_t> ring;  ///< 0: the outer ring; then the holes

  std::size_t size() const { return vertices.size(); }
  bool has_holes() const { return ring.back() > 0; }
  std::span<const Point> outer_corners() const {
    return std::span(vertices).first(static_cast<std::size_t>(std::ranges::upper_bound(ring, 0U) - ring.begin()));
  }
  Point from(std::uint32_t edge) const { return vertices[edge]; }
  Point to(std::uint32_t edge) const { return vertices[next[edge]]; }
};

EdgeList edge_list(const Polygon& polygon);

/// The edges on which a piece of boundary lies.
struct PieceEdges {
  std::uint32_t first_edge = 0;
  std::uint32_t edges = 1;  ///< number of edges, which follow each other in one ring
};

/// A piece of boundary with one contact circle: a part of one long edge, or several short consecutive edges.
struct BoundaryPiece : PieceEdges {
  Point middle;                   ///< half-way along the piece, on the boundary, in the body frame [m]
  double reach = 0;               ///< largest distance of its points from the middle [m]
  std::uint32_t middle_edge = 0;  ///< edge on which the middle lies
};

/// Divides all boundaries of a polygon into pieces, in ring order, one per `radius` of boundary or less, but at most
/// `most` on one edge.
std::vector<BoundaryPiece> boundary_pieces(const EdgeList& edges, double radius,
                                           double most = std::numeric_limits<double>::infinity());

/// A circle that touches the boundary from inside at the middle of its piece.
struct ContactCircle {
  Point centre;       ///< in the body frame [m]
  double radius = 0;  ///< at most the setting's; smaller if the ice is too narrow for it [m]
  double reach = 0;   ///< largest distance of its piece of boundary from the centre [m]
};

/// Returns the contact circles of the pieces of a polygon's boundaries, one each. [Sawamura2017] sets them along
/// waterline and floe edges with a radius of 1.0 m. Deviation: a circle never leaves the ice. Near corners and in
/// narrow places it shrinks until it touches the boundary twice, so the union of the circles tends to the polygon as
/// the radius tends to zero.
std::vector<ContactCircle> sample_contact_circles(const EdgeList& edges, const std::vector<BoundaryPiece>& pieces,
                                                  double radius);

/// A circle that contains a piece of boundary.
struct BoundingCircle {
  Point centre;      ///< [m]
  double reach = 0;  ///< [m]
};

/// A node of the tree over a boundary's bounding circles: a circle around all circles of the node.
struct CircleNode {
  Point centre;             ///< [m]
  double reach = 0;         ///< [m]
  std::uint32_t first = 0;  ///< first bounding circle
  std::uint32_t count = 0;  ///< number of bounding circles; the children have half of them each
  std::uint32_t right = 0;  ///< index of the second child (the first is the next node); 0 for a leaf
};

/// Settings for the circles of a boundary.
struct CircleRule {
  double circle_radius = 1.0;  ///< radius of contact circles, and largest length of a piece [m]
  bool has_circles = false;    ///< contact circles, for find_circle_manifolds: bounding circles then share
                               ///< their centres; without, they stand on the boundary and are tighter
};

/// The data that find the near parts of two boundaries: the pieces of a boundary, their bounding circles, and a tree
/// over these, in the body frame. They follow from the edges and take far more memory.
struct Cover {
  std::vector<PieceEdges> pieces;
  std::vector<ContactCircle> circles;            ///< of the pieces; empty if the rule has none
  std::vector<BoundingCircle> bounding_circles;  ///< of the pieces, about the centres of contact circles or the middles
  std::vector<CircleNode> tree;
};

/// Makes the cover of a boundary, and reuses the memory of the earlier cover.
void make_cover(const EdgeList& edges, const CircleRule& rule, Cover& cover);

/// Returns approximately how many pieces the boundary has.
double pieces_of(const EdgeList& edges, double circle_radius);

/// The boundary of a body: its edges in the body frame, and its cover if that is kept.
struct Boundary {
  EdgeList edges;
  std::shared_ptr<const Cover> cover;

  bool is_ready() const { return cover != nullptr; }
};

/// A boundary with its cover, wherever that is kept, ready for finding contacts.
struct Covered {
  Covered(const EdgeList& edges_of_it, const Cover& cover_of_it) : edges(edges_of_it), cover(cover_of_it) {}
  Covered(const Boundary& ready) : edges(ready.edges), cover(*ready.cover) {}  // NOLINT: it is one
  const EdgeList& edges;
  const Cover& cover;
};

/// Makes a boundary with edges only: enough for a floe that no body approaches.
Boundary make_outline(const Polygon& polygon);

/// Makes a boundary's cover and keeps it.
void make_ready(Boundary& boundary, const CircleRule& rule);

/// Calls use(edge), in order and once, for each edge with a bounding circle for which matters(circle) is true, and
/// possibly for others; for all edges if the boundary is not ready. If `matters` is true for a circle, it must be true
/// for every circle that contains it.
template <class Matters, class Use>
void for_edges(const Boundary& boundary, Matters matters, Use use) {
  if (!boundary.is_ready()) {
    for (std::uint32_t edge = 0; edge < boundary.edges.size(); ++edge) use(edge);
    return;
  }
  const Cover& cover = *boundary.cover;
  std::uint32_t next = 0;  // a long edge has several pieces but is used once
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

/// Returns true if a point is inside and not in a hole. Exact.
bool is_inside(const EdgeList& edges, Point p);

}  // namespace polynya::geometry
