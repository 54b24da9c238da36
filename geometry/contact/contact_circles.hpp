#pragma once

#include <cstdint>
#include <limits>
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
  Point from(std::uint32_t edge) const { return vertices[edge]; }
  Point to(std::uint32_t edge) const { return vertices[next[edge]]; }
};

EdgeList edge_list(const Polygon& polygon);

/// A piece of boundary with one contact circle: a part of one long edge, or some short edges in a
/// row.
struct BoundaryPiece {
  Point middle;                   ///< half-way along it, on the boundary, in the body frame [m]
  double reach = 0;               ///< no point of it is farther from the middle [m]
  std::uint32_t first_edge = 0;   ///< it lies on the edges first_edge …
  std::uint32_t edges = 1;        ///< … and the next ones of the same ring, this many in all
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

}  // namespace polynya::geometry
