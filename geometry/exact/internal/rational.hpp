#pragma once

#include <gmpxx.h>

#include "geometry/shape/point.hpp"

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

}  // namespace polynya::geometry::exact
