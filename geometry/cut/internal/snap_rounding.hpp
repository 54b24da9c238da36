#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry::exact {

/// The numbers that round to one double.
struct Cell {
  Rational low;
  Rational high;
  bool has_low = true;  ///< the ends themselves are among them
  bool has_high = true;
};

/// The doubles to which coordinates are rounded: all doubles, or evenly spaced ones. Cells are disjoint and cover the
/// line.
class Lattice {
 public:
  /// All doubles: coordinates round to the nearest one, ties to even. Steps shrink towards zero.
  static Lattice of_doubles() { return Lattice(true, 0); }
  /// Multiples of the step between doubles at the farthest coordinate of the polygon; all of them are doubles.
  static Lattice spanning(const Polygon& polygon);

  double nearest(const Rational& value) const;
  geometry::Point nearest(const Point& p) const { return {nearest(p.x), nearest(p.y)}; }
  Cell cell(double centre) const;
  /// Returns at least the width of the cells at the distance `size` from zero.
  double width(double size) const;

 private:
  Lattice(bool is_of_doubles, int exponent) : is_of_doubles_(is_of_doubles), exponent_(exponent) {}
  bool is_of_doubles_;
  int exponent_;  // of the even step, 2^exponent
};

/// Snap rounding [Hobby1999; GuibasMarimont1998]: every vertex of a valid polygon moves to the lattice point in whose
/// cell it lies, and every edge that passes through such a cell bends to its lattice point too. Points closer together
/// than a cell are merged, and no edge crosses another. On evenly spaced lattices that is a theorem; on all doubles,
/// whose cells have different sizes, it may fail.
///
/// Returns the areas that the rings then enclose, as valid polygons: several if a neck has closed, none if nothing is
/// left. Returns nullopt if they are not valid.
std::optional<std::vector<geometry::Polygon>> snapped(const Polygon& polygon, const Lattice& lattice);

/// A piece of a cut before rounding.
struct ExactPiece {
  Polygon polygon;
  Part part = Part::kOutside;
};

/// Checks Σ pieces = parent in rationals, and rounds every piece to valid polygons of doubles: each vertex once, to
/// nearest, if the result is valid; otherwise by snap rounding. Slivers are removed and recorded in the ledger. Fails
/// (kInternal) only if the sum is not exact or a piece is invalid before rounding.
CutOutcome rounded_pieces(const Rational& area_before, const std::vector<ExactPiece>& pieces);

/// Sorts pieces into the order that results have: by part, then by the x and the y of their leftmost vertex.
void sort_pieces(std::vector<Piece>& pieces);

}  // namespace polynya::geometry::exact
