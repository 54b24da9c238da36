#pragma once

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry::exact {

/// The numbers that round to one double.
struct Cell {
  Rational low;
  Rational high;
  bool has_low = true;  ///< are the ends themselves among them?
  bool has_high = true;
};

/// Doubles to which coordinates are rounded: all of them, or evenly spaced ones. Cells are disjoint and cover
/// the line.
class Lattice {
 public:
  /// All doubles: the nearest, ties to even. Steps shrink towards zero.
  static Lattice of_doubles() { return Lattice(true, 0); }
  /// Multiples of the step between doubles at the farthest coordinate of the polygon, all of which are
  /// doubles.
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

}  // namespace polynya::geometry::exact
