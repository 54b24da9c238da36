#pragma once

#include <vector>

#include <gmpxx.h>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry::exact {

/// Plain rationals: no lazy expression trees, so no depth limit and no hidden evaluation.
using Rational = mpq_class;

/// A point with rational coordinates [m].
struct Point {
  Rational x;
  Rational y;
  friend bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }
};

inline Point exactly(geometry::Point p) {
  return {Rational(p.x), Rational(p.y)};
}

/// The double nearest to a rational (ties to even). GMP's own conversion truncates.
double nearest_double(const Rational& value);

/// Both coordinates rounded to nearest, each once.
inline geometry::Point rounded(const Point& p) {
  return {nearest_double(p.x), nearest_double(p.y)};
}

/// Twice the signed area of the triangle (origin, a, b): the term of the shoelace sum.
inline Rational shoelace_term(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

/// Sign of (b − a) × (c − a): +1 where a, b, c turn left.
inline int orientation(const Point& a, const Point& b, const Point& c) {
  return sgn(Rational((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
}

using Ring = std::vector<Point>;

/// A polygon with rational vertices: the outer ring counter-clockwise, holes clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

Ring exactly(const geometry::Ring& ring);
Polygon exactly(const geometry::Polygon& polygon);

/// Every vertex to its nearest doubles. Nothing is welded: the result may be invalid.
geometry::Polygon rounded(const Polygon& polygon);

/// Signed area: positive where the ring runs counter-clockwise [m²].
Rational area(const Ring& ring);
/// Area with the holes (which run clockwise) taken off [m²].
Rational area(const Polygon& polygon);
Rational area(const geometry::Ring& ring);
Rational area(const geometry::Polygon& polygon);

}  // namespace polynya::geometry::exact
