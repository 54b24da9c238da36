#include "geometry/exact/predicates.hpp"

#include <limits>

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {

namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon() / 2;
// [Shewchuk1997] orient2d's bound A, (3 + 16ε)ε, holds for differences of any two pairs of points. Smaller: the signs
// of nearly degenerate points would be signs of rounding errors. Larger: only more time.
constexpr double kBound = (3 + 16 * kEps) * kEps;
// Products below this may have lost bits to underflow (2⁻¹⁰²² = 2e-308, minus 53 bits), which the bound does not cover
// [m²]. Without this term the signs of points 1e-150 m apart would be wrong.
constexpr double kUnderflow = 1e-280;

// Returns true if a product of two such factors, and its error, can be formed in doubles. Beyond 1e±150 one of them
// over- or underflows, and two_product is not error-free.
bool safe_factor(double v) {
  return v == 0 || (std::abs(v) > 1e-130 && std::abs(v) < 1e130);
}

int sign(double v) {
  return (v > 0) - (v < 0);
}

// Returns the sign of ux·vy ∓ uy·vx with exact factors.
int sign_of_products(double left_a, double left_b, double right_a, double right_b) {
  const TwoDoubles left = two_product(left_a, left_b);
  const TwoDoubles right = two_product(right_a, right_b);
  // Rounding is monotone: if the rounded products differ, the products differ in the same order.
  if (left.high != right.high) return left.high > right.high ? 1 : -1;
  return sign(left.low - right.low);
}

struct Differences {
  double ux, uy, vx, vy;
  bool exact;
};

Differences differences(Point a, Point b, Point c, Point d) {
  const Differences u{b.x - a.x, b.y - a.y, d.x - c.x, d.y - c.y, false};
  const bool exact = safe_factor(u.ux) && safe_factor(u.uy) && safe_factor(u.vx) && safe_factor(u.vy) &&
                     two_difference(b.x, a.x).low == 0 && two_difference(b.y, a.y).low == 0 &&
                     two_difference(d.x, c.x).low == 0 && two_difference(d.y, c.y).low == 0;
  return {u.ux, u.uy, u.vx, u.vy, exact};
}

int cross_sign_slow(Point a, Point b, Point c, Point d) {
  const Differences u = differences(a, b, c, d);
  if (u.exact) return sign_of_products(u.ux, u.vy, u.uy, u.vx);
  using exact::Rational;
  const Rational ux = Rational(b.x) - Rational(a.x);
  const Rational uy = Rational(b.y) - Rational(a.y);
  const Rational vx = Rational(d.x) - Rational(c.x);
  const Rational vy = Rational(d.y) - Rational(c.y);
  return exact::sign(Rational(ux * vy - uy * vx));
}

}  // namespace

int cross_sign(Point a, Point b, Point c, Point d) {
  const double left = (b.x - a.x) * (d.y - c.y);
  const double right = (b.y - a.y) * (d.x - c.x);
  const double det = left - right;
  const double bound = kBound * (std::abs(left) + std::abs(right)) + kUnderflow;
  if (det > bound) return 1;
  if (-det > bound) return -1;
  return cross_sign_slow(a, b, c, d);
}

int dot_sign(Point a, Point b, Point c, Point d) {
  // u · v = u × (v rotated back by 90°), so the same bound holds.
  const double left = (b.x - a.x) * (d.x - c.x);
  const double right = (b.y - a.y) * (d.y - c.y);
  const double sum = left + right;
  const double bound = kBound * (std::abs(left) + std::abs(right)) + kUnderflow;
  if (sum > bound) return 1;
  if (-sum > bound) return -1;
  const Differences u = differences(a, b, c, d);
  if (u.exact) return sign_of_products(u.ux, u.vx, -u.uy, u.vy);
  using exact::Rational;
  const Rational xs = (Rational(b.x) - Rational(a.x)) * (Rational(d.x) - Rational(c.x));
  const Rational ys = (Rational(b.y) - Rational(a.y)) * (Rational(d.y) - Rational(c.y));
  return exact::sign(Rational(xs + ys));
}

int area_sign(const Ring& ring) {
  if (ring.size() < 3) return 0;
  const Point o = ring.front();
  double sum = 0;
  double magnitude = 0;
  for_ring_edges(ring, [&](Point from, Point to) {
    const Vector u = from - o;
    const Vector v = to - o;
    sum += cross(u, v);
    magnitude += std::abs(u.x * v.y) + std::abs(u.y * v.x);
  });
  // Each term has an error of at most 4ε of its magnitude, and the running sums of nε of theirs.
  const double bound = (static_cast<double>(ring.size()) + 8) * 2 * kEps * magnitude + kUnderflow;
  if (sum > bound) return 1;
  if (-sum > bound) return -1;
  return exact::sign(exact::area(ring));
}

namespace {

// Computed in plain doubles, for messages only.
Point approximate_crossing(Point a, Point b, Point c, Point d) {
  const double denominator = cross(b - a, d - c);
  if (denominator == 0) return midpoint(a, b);
  const double t = std::clamp(cross(c - a, d - c) / denominator, 0.0, 1.0);
  return a + t * (b - a);
}

SegmentMeeting meet_collinear(Point a, Point b, Point c, Point d) {
  const bool by_x = a.x != b.x || c.x != d.x;
  const auto less = [by_x](Point p, Point q) { return by_x ? p.x < q.x : p.y < q.y; };
  if (less(b, a)) std::swap(a, b);
  if (less(d, c)) std::swap(c, d);
  const Point low = less(a, c) ? c : a;
  const Point high = less(b, d) ? b : d;
  if (less(high, low)) return {};
  return {low == high ? Meeting::kTouch : Meeting::kOverlap, low};
}

}  // namespace

SegmentMeeting meet(Point a, Point b, Point c, Point d) {
  const int side_c = orientation(a, b, c);
  const int side_d = orientation(a, b, d);
  if (side_c * side_d > 0) return {};
  const int side_a = orientation(c, d, a);
  const int side_b = orientation(c, d, b);
  if (side_a * side_b > 0) return {};
  if (side_c == 0 && side_d == 0) return meet_collinear(a, b, c, d);
  if (side_c == 0 && in_span(a, b, c)) return {Meeting::kTouch, c};
  if (side_d == 0 && in_span(a, b, d)) return {Meeting::kTouch, d};
  if (side_a == 0 && in_span(c, d, a)) return {Meeting::kTouch, a};
  if (side_b == 0 && in_span(c, d, b)) return {Meeting::kTouch, b};
  if (side_a * side_b < 0 && side_c * side_d < 0) {
    return {Meeting::kCross, approximate_crossing(a, b, c, d)};
  }
  return {};
}

namespace {

// 0 along `from`, 1 in the left half-plane, 2 against it, 3 in the right half-plane.
int turn_class(const Ray& from, const Ray& a) {
  const int side = cross_sign(from, a);
  if (side != 0) return side > 0 ? 1 : 3;
  return dot_sign(from.tail, from.head, a.tail, a.head) > 0 ? 0 : 2;
}

}  // namespace

bool met_before(const Ray& from, const Ray& a, const Ray& b) {
  const int class_a = turn_class(from, a);
  const int class_b = turn_class(from, b);
  if (class_a != class_b) return class_a < class_b;
  return (class_a == 1 || class_a == 3) && cross_sign(a, b) > 0;
}

int side_of_ring(const Ring& ring, Point p) {
  bool inside = false;
  Point a = ring.back();
  for (const Point b : ring) {
    const bool is_level = a.y == p.y && b.y == p.y;
    const bool may_hold =
        p.x <= std::max(a.x, b.x) && p.x >= std::min(a.x, b.x) && (is_level || (a.y > p.y) != (b.y > p.y));
    if (b == p || (may_hold && orientation(a, b, p) == 0)) return 0;
    if (crosses_ray(a, b, p)) inside = !inside;
    a = b;
  }
  return inside ? 1 : -1;
}

bool contains(const Polygon& polygon, Point point) {
  if (polygon.outer.empty()) return false;
  const int side = side_of_ring(polygon.outer, point);
  bool inside = side > 0;
  if (side == 0) return true;
  for (const Ring& hole : polygon.holes) {
    const int of_hole = hole.empty() ? -1 : side_of_ring(hole, point);
    if (of_hole == 0) return true;
    if (of_hole > 0) inside = !inside;
  }
  return inside;
}

bool contains_strictly(const Polygon& polygon, Point p) {
  if (side_of_ring(polygon.outer, p) <= 0) return false;
  return std::all_of(polygon.holes.begin(), polygon.holes.end(),
                     [p](const Ring& hole) { return side_of_ring(hole, p) < 0; });
}

}  // namespace polynya::geometry
