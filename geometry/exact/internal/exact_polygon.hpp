#pragma once

#include <vector>

#include "geometry/exact/internal/rational.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// An unevaluated sum: high is the nearest double of it.
struct TwoDoubles {
  double high;
  double low;
};

/// A double as the sum of two of 26 bits, whose products are exact (Veltkamp). No overflow below 1e300.
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

/// high + low = a·b exactly, if nothing over- or underflows (Dekker).
inline TwoDoubles two_product(double a, const SplitDouble& split_a, double b, const SplitDouble& split_b) {
  const double p = a * b;
  return {p, split_a.low * split_b.low -
                 (((p - split_a.high * split_b.high) - split_a.low * split_b.high) - split_a.high * split_b.low)};
}
inline TwoDoubles two_product(double a, double b) {
  return two_product(a, SplitDouble(a), b, SplitDouble(b));
}

/// high + low = a + b exactly (Knuth).
inline TwoDoubles two_sum(double a, double b) {
  const double x = a + b;
  const double b_virtual = x - a;
  const double a_virtual = x - b_virtual;
  return {x, (a - a_virtual) + (b - b_virtual)};
}

/// high + low = a − b exactly.
inline TwoDoubles two_difference(double a, double b) {
  const double x = a - b;
  const double b_virtual = a - x;
  const double a_virtual = x + b_virtual;
  return {x, (a - a_virtual) + (b_virtual - b)};
}

/// A sum that keeps the exact error of its additions (Knuth's two-sum, which needs no branch): the error does
/// not grow with the number of terms.
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

// ---- areas in such sums

/// A ring's signed area with generous bounds on its errors: within them, decide in rationals.
struct RingArea {
  double area = 0;       ///< compensated sum about the ring's first vertex [m²]
  double doubt = 0;      ///< |area − exact area of these vertices| is below this [m²]
  double step_area = 0;  ///< area by which moving every vertex by one step between doubles can change it [m²]
};

/// One pass over the vertices.
RingArea ring_area(const Ring& ring);

/// The polygon's area by its rings' [m²]: within 1e-6 of the exact one as a bound, within some 1e-15 as a
/// rule; the nearest double where the bounds leave that open.
double area_of(const Polygon& polygon, const std::vector<RingArea>& rings);
double area_of(const Polygon& polygon);

/// The double nearest to the exact area of a polygon [m²], its holes (which run clockwise) taken off. NaN where a
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

/// The double nearest to a rational (ties to even).
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
  return sign(Rational((b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x)));
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
