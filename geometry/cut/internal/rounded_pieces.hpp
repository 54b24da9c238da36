#pragma once

#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry::exact {

/// A piece of a cut before rounding.
struct ExactPiece {
  Polygon polygon;
  Part part = Part::kOutside;
};

/// Checks Σ pieces = parent in rationals and rounds every piece to valid polygons of doubles: each vertex
/// once, to nearest, where that is valid; by snap rounding where it is not; slivers are removed into the
/// ledger. Fails (kInternal) only where a piece is not a valid polygon to begin with.
CutOutcome rounded_pieces(const Rational& area_before, const std::vector<ExactPiece>& pieces);

/// Pieces in the order a result promises: by part, then by lowest vertex.
void sort_pieces(std::vector<Piece>& pieces);

}  // namespace polynya::geometry::exact
