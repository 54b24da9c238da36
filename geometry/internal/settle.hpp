#pragma once

#include <vector>

#include "geometry/cut.hpp"
#include "geometry/internal/exact_polygon.hpp"

namespace polynya::geometry::exact {

/// A piece of a cut before rounding.
struct ExactPiece {
  Polygon polygon;
  Part part = Part::kOutside;
};

/// Checks Σ pieces = parent in rationals, rounds every vertex once, and settles what rounding broke: rings
/// are retraced at pinches, slivers removed into the ledger, and what is still invalid keeps its rationals.
CutOutcome settle(const Rational& area_before, std::vector<ExactPiece> pieces);

/// Pieces in the order a result promises: by part, then by lowest vertex.
void sort_pieces(std::vector<Piece>& pieces);

}  // namespace polynya::geometry::exact
