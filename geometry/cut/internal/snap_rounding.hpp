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
  bool has_low = true;  ///< are the ends themselves among them?
  bool has_high = true;
};

/// Doubles to which coordinates are rounded: all of them, or evenly spaced ones. Cells are disjoint and cover the line.
class Lattice {
 public:
  /// All doubles: the nearest, ties to even. Steps shrink towards zero.
  static Lattice of_doubles() { return Lattice(true, 0); }
  /// Multiples of the step between doubles at the farthest coordinate of the polygon, all of which are doubles.
  static Lattice spanning(const Polygon& polygon);

  double nearest(const Rational& value) const;
  geometry::Point nearest(const Point& p) const { return {nearest(p.x), nearest(p.y)}; }
  Cell cell(double centre) const;
  /// At least the width of the cells as far out as `size`.
  double width(double size) const;

 private:
  Lattice(bool is_of_doubles, int exponent) : is_of_doubles_(is_of_doubles), exponent_(exponent) {}
  bool is_of_doubles_;
  int exponent_;  // of the even step, 2^exponent
};

/// Snap rounding [Hobby1999; GuibasMarimont1998]: every vertex of a valid polygon moves to the point of the
/// lattice whose cell it lies in, and every edge that passes through such a cell bends to its point too. What
/// lies closer together than a cell becomes one, and no edge crosses another: on evenly spaced lattices that
/// is a theorem, on all doubles, whose cells differ in size, it may fail.
///
/// Returns what the rings then enclose, as valid polygons: several where a neck closed, none where nothing is
/// left. No value where they are not valid.
std::optional<std::vector<geometry::Polygon>> snapped(const Polygon& polygon, const Lattice& lattice);

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
