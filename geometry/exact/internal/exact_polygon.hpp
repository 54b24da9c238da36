#pragma once

#include <vector>

#include "geometry/exact/internal/rational.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// An unevaluated sum; `high` is the nearest double to it.
struct TwoDoubles {
  double high;
  double low;
};

/// A double as the sum of two numbers of 26 bits, whose products are exact (Veltkamp). No overflow below 1e300.
struct SplitDouble {
  explicit SplitDouble(double value) {
    constexpr double kSplitter = 134217729.0;  // 2^27 + 1
    const double c = kSplitter * value;
    high = c - (c - value);
    low = value - high;
  }
  double high;
  double low;
};

/// Returns high + low = a·b exactly, if nothing over- or underflows (Dekker).
inline TwoDoubles two_product(double a, const SplitDouble& split_a, double b, const SplitDouble& split_b) {
  const double p = a * b;
  return {p, split_a.low * split_b.low -
                 (((p - split_a.high * split_b.high) - split_a.low * split_b.high) - split_a.high * split_b.low)};
}
inline TwoDoubles two_product(double a, double b) {
  return two_product(a, SplitDouble(a), b, SplitDouble(b));
}

/// Returns high + low = a + b exactly (Knuth).
inline TwoDoubles two_sum(double a, double b) {
  const double x = a + b;
  const double b_virtual = x - a;
  const double a_virtual = x - b_virtual;
  return {x, (a - a_virtual) + (b - b_virtual)};
}

/// Returns high + low = a − b exactly.
inline TwoDoubles two_difference(double a, double b) {
  const double x = a - b;
  const double b_virtual = a - x;
  const double a_virtual = x + b_virtual;
  return {x, (a - a_virtual) + (b_virtual - b)};
}

/// A sum that keeps the exact error of its additions (Knuth's two-sum, without a branch): its error does not grow with
/// the number of terms.
struct CompensatedSum {
  double value = 0;
  double lost = 0;
  void operator+=(double term) {
    const double next = value + term;
    const double virtual_term = next - value;
    lost += (value - (next - virtual_term)) + (term - virtual_term);
    value = next;
  }
  double total() const { return value + lost; }
};

// ---- areas by such sums

/// A ring's signed area with generous error bounds; decisions within these bounds must be made in rationals.
struct RingArea {
  double area = 0;       ///< compensated sum about the ring's first vertex [m²]
  double doubt = 0;      ///< |area − exact area of these vertices| is below this [m²]
  double step_area = 0;  ///< largest change of the area if every vertex moves by one step between doubles [m²]
};

/// Computes the area in one pass over the vertices.
RingArea ring_area(const Ring& ring);

/// Returns the polygon's area from its rings' areas [m²]: guaranteed within 1e-6 of the exact one, usually within about
/// 1e-15; the nearest double if the bounds leave that open.
double area_of(const Polygon& polygon, const std::vector<RingArea>& rings);
double area_of(const Polygon& polygon);

/// Returns the double nearest to the exact area of a polygon without its holes, which run clockwise [m²]; NaN if a
/// coordinate is not finite.
double nearest_area(const Polygon& polygon);

}  // namespace polynya::geometry

namespace polynya::geometry::exact {

/// A point with rational coordinates [m].
struct Point {
  Rational x;
  Rational y;
  friend bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y; }
};

inline Point exactly(geometry::Point p) {
  return {Rational(p.x), Rational(p.y)};
}

/// Returns the double nearest to a rational (ties to even). GMP's own conversion truncates.
double nearest_double(const Rational& value);

/// Returns the point with both coordinates rounded to nearest, each once.
inline geometry::Point rounded(const Point& p) {
  return {nearest_double(p.x), nearest_double(p.y)};
}

/// Returns twice the signed area of the triangle (origin, a, b): the term of the shoelace sum.
inline Rational shoelace_term(const Point& a, const Point& b) {
  return a.x * b.y - a.y * b.x;
}

using Ring = std::vector<Point>;

/// A polygon with rational vertices: the outer ring counter-clockwise, holes clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

Ring exactly(const geometry::Ring& ring);
Polygon exactly(const geometry::Polygon& polygon);

/// Returns the polygon with every vertex rounded to the nearest doubles. Vertices are not merged, so the result may be
/// invalid.
geometry::Polygon rounded(const Polygon& polygon);

/// Returns the signed area, positive if the ring runs counter-clockwise [m²].
Rational area(const Ring& ring);
/// Returns the area without the holes, which run clockwise [m²].
Rational area(const Polygon& polygon);
Rational area(const geometry::Ring& ring);
Rational area(const geometry::Polygon& polygon);

}  // namespace polynya::geometry::exact
