#pragma once

#include <vector>

#include "geometry/contact/contact_circles.hpp"

namespace polynya::geometry {

/// boundary_pieces, no more than `most` of them on one edge.
std::vector<BoundaryPiece> boundary_pieces(const EdgeList& edges, double radius, double most);

/// Whether an edge crosses the ray that goes from the point to the right.
inline bool is_right_of(const EdgeList& edges, std::uint32_t edge, Point p) {
  const Point from = edges.from(edge);
  const Point to = edges.to(edge);
  return (from.y > p.y) != (to.y > p.y) && (cross(to - from, p - from) > 0) == (to.y > from.y);
}

}  // namespace polynya::geometry
