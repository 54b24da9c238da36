#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/cut.hpp"

namespace polynya::geometry {

/// What is left of a polygon where larger ones overlap it.
struct Trimmed {
  std::vector<Polygon> pieces;      ///< valid; the polygon itself where nothing overlaps it, none if all is
  std::vector<std::size_t> yields;  ///< to which of the polygons, ascending
  double area_trimmed = 0;          ///< Σ exact areas taken off, slivers among them [m²]
  double rounding_defect = 0;       ///< Σ of the cuts': pieces as returned − exact pieces [m²]
  std::optional<CutError> error;    ///< of a cut that geometry refused; the pieces are then empty
};

/// Makes polygons disjoint: where two share area it stays with the larger one, of equal ones with the first.
/// With a gap, all that lies nearer to the larger one than that is cut off too, up to 4 % farther at its
/// corners [m]. Shared areas of at most kTouchingArea (overlapping_pairs.hpp) are the rounding of shared
/// edges and stay. All polygons must be valid. Each is cut exactly, by one of the others after the other;
/// CGAL finds the pairs whose boxes meet.
std::vector<Trimmed> make_disjoint(const std::vector<Polygon>& polygons, double gap);

}  // namespace polynya::geometry
