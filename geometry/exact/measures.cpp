#include "geometry/exact/measures.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {

// ---- areas

namespace {

using exact::Rational;

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;  // unit roundoff u

// Twice an area: |value + low − exact| is below doubt.
struct TwiceArea {
  double value = 0;
  double low = 0;
  double doubt = 0;

  void operator+=(const TwiceArea& other) {
    const TwoDoubles sum = two_sum(value, other.value);
    value = sum.high;
    low += sum.low + other.low;
    doubt += other.doubt;
  }
};

// A difference of coordinates: exactly high + low, with high also split in halves.
struct Difference {
  Difference(double a, double b) : both(two_difference(a, b)), halves(both.high) {}
  TwoDoubles both;
  SplitDouble halves;
};

// Shoelace sum about the first vertex, with twice the digits of a double: the errors of products and sums are kept in
// `low`. Let R be the product of the farthest |x| and |y|, and V the largest partial sum. One edge adds at most
// u(8R + V) to `low`. The loss by adding that n times, and by the products of two tails, is below (n + 8)²u²(8R + V).
TwiceArea twice_area(const Ring& ring) {
  TwiceArea sum;
  if (ring.size() < 3) return sum;
  const Point origin = ring.front();
  double reach_x = 0;
  double reach_y = 0;
  double largest = 0;
  Difference ux(origin.x, origin.x);
  Difference uy(origin.y, origin.y);
  for (const Point p : ring) {
    const Difference vx(p.x, origin.x);
    const Difference vy(p.y, origin.y);
    const TwoDoubles left = two_product(ux.both.high, ux.halves, vy.both.high, vy.halves);
    const TwoDoubles right = two_product(uy.both.high, uy.halves, vx.both.high, vx.halves);
    const TwoDoubles term = two_difference(left.high, right.high);
    const double tails = (ux.both.high * vy.both.low + ux.both.low * vy.both.high) -
                         (uy.both.high * vx.both.low + uy.both.low * vx.both.high);
    const TwoDoubles next = two_sum(sum.value, term.high);
    sum.value = next.high;
    sum.low += next.low + (term.low + (left.low - right.low) + tails);
    largest = std::max(largest, std::abs(sum.value));
    reach_x = std::max(reach_x, std::abs(vx.both.high));
    reach_y = std::max(reach_y, std::abs(vy.both.high));
    ux = vx;
    uy = vy;
  }
  constexpr double kEdgeUnderflow = 1e-300;  // of one edge's products, with a margin
  const double edges = static_cast<double>(ring.size()) + 8;
  const double steps = edges * kUnit;
  sum.doubt = 2 * steps * steps * (8 * reach_x * reach_y + largest) + edges * kEdgeUnderflow;
  return sum;
}

// Returns half of the sum as the nearest double, or nullopt if the doubt allows several.
std::optional<double> nearest_half(const TwiceArea& twice) {
  const TwoDoubles sum = two_sum(twice.value, twice.low);
  const double gap = std::abs(sum.high) - std::nextafter(std::abs(sum.high), 0);  // distance to the closer neighbour
  if (std::abs(sum.low) + twice.doubt < gap / 2) return sum.high / 2;
  return {};
}

bool is_finite(const Polygon& polygon) {
  const auto is_finite = [](Point p) { return std::isfinite(p.x) && std::isfinite(p.y); };
  const auto all_finite = [&](const Ring& ring) { return std::ranges::all_of(ring, is_finite); };
  return all_finite(polygon.outer) && std::ranges::all_of(polygon.holes, all_finite);
}

}  // namespace

double signed_area(const Ring& ring) {
  const auto nearest = nearest_half(twice_area(ring));
  return nearest ? *nearest : exact_area({ring, {}});
}

double nearest_area(const Polygon& polygon) {
  TwiceArea sum = twice_area(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += twice_area(hole);
  const auto nearest = nearest_half(sum);
  return nearest ? *nearest : exact_area(polygon);
}

RingArea ring_area(const Ring& ring) {
  const std::size_t n = ring.size();
  if (n < 3) return {};
  const Point origin = ring.front();
  // Two sums are computed side by side, since one alone would wait for its own last addition.
  CompensatedSum even;
  CompensatedSum odd;
  double reach_x = 0;  // largest |x| of all vertices from the origin
  double reach_y = 0;
  Vector u{0, 0};
  const auto term_to = [&](Point p) {
    const Vector v = p - origin;
    const double term = cross(u, v);
    reach_x = std::max(reach_x, std::abs(v.x));
    reach_y = std::max(reach_y, std::abs(v.y));
    u = v;
    return term;
  };
  std::size_t i = 1;
  for (; i + 1 < n; i += 2) {
    even += term_to(ring[i]);
    odd += term_to(ring[i + 1]);
  }
  if (i < n) even += term_to(ring[i]);  // the closing edge ends at the origin: its term is zero
  const double twice = (even.value + odd.value) + (even.lost + odd.lost);
  const double largest = std::max(std::abs(origin.x) + reach_x, std::abs(origin.y) + reach_y);
  const double step = std::nextafter(largest, std::numeric_limits<double>::infinity()) - largest;
  const auto edges = static_cast<double>(n);
  // Each term has an error of at most 4ε of its two products; the compensated sums have practically none.
  constexpr double kSumUnderflow = 1e-280;
  return {twice / 2, 8 * std::numeric_limits<double>::epsilon() * edges * 2 * reach_x * reach_y + kSumUnderflow,
          4 * edges * (reach_x + reach_y) * step};
}

double area_of(const Polygon& polygon, const std::vector<RingArea>& rings) {
  RingArea sum;
  for (const RingArea& ring : rings) {
    sum.area += ring.area;
    sum.doubt += ring.doubt;
  }
  constexpr double kWorstDoubt = 1e-6;  // of the area; larger: thin pieces could weigh too much or too little
  return sum.doubt > kWorstDoubt * std::abs(sum.area) ? nearest_area(polygon) : sum.area;
}

double area_of(const Polygon& polygon) {
  std::vector<RingArea> rings{ring_area(polygon.outer)};
  for (const Ring& hole : polygon.holes) rings.push_back(ring_area(hole));
  return area_of(polygon, rings);
}

double exact_area(const Polygon& polygon) {
  const Polygon* const only[]{&polygon};
  return exact_balance(only, {}, {});
}

double exact_balance(std::span<const Polygon* const> after, std::span<const Polygon* const> before,
                     std::span<const double> terms) {
  const auto finite = [](const Polygon* polygon) { return is_finite(*polygon); };
  if (!std::ranges::all_of(after, finite) || !std::ranges::all_of(before, finite) ||
      !std::ranges::all_of(terms, [](double term) { return std::isfinite(term); }))
    return std::numeric_limits<double>::quiet_NaN();
  Rational sum = 0;
  for (const Polygon* polygon : after) sum += exact::area(*polygon);
  for (const Polygon* polygon : before) sum -= exact::area(*polygon);
  for (const double term : terms) sum += Rational(term);
  return exact::nearest_double(sum);
}

// ---- measures

namespace {

// Integrals over a region of 1, of the position and of its square, without the constant factors of Green's theorem.
struct RegionMoments {
  Rational twice_area = 0;
  Rational six_first_x = 0;
  Rational six_first_y = 0;
  Rational twelve_second = 0;
};

// Taken about the frame's origin, since rationals lose no digits far from it.
void add(RegionMoments& moments, const Ring& ring) {
  if (ring.size() < 3) return;
  exact::Point u = exact::exactly(ring.back());
  for (const Point p : ring) {
    exact::Point v = exact::exactly(p);
    const Rational w = exact::shoelace_term(u, v);
    moments.twice_area += w;
    moments.six_first_x += w * (u.x + v.x);
    moments.six_first_y += w * (u.y + v.y);
    moments.twelve_second += w * (u.x * (u.x + v.x) + v.x * v.x + u.y * (u.y + v.y) + v.y * v.y);
    u = std::move(v);
  }
}

// Measures of a valid polygon, computed in rationals and rounded once: for slivers, whose moments in doubles are noise.
Measures exact_measures(const Polygon& polygon) {
  RegionMoments moments;
  add(moments, polygon.outer);
  for (const Ring& hole : polygon.holes) add(moments, hole);
  if (moments.twice_area == 0) return {0, polygon.outer.front(), 0};
  const Rational area = moments.twice_area / 2;
  const exact::Point centroid{moments.six_first_x / (6 * area), moments.six_first_y / (6 * area)};
  const Rational second = moments.twelve_second / 12 - area * (centroid.x * centroid.x + centroid.y * centroid.y);
  return {exact::nearest_double(area), exact::rounded(centroid), exact::nearest_double(second)};
}

// Calls visit(u, v, w) for each edge a→b with u = a − origin, v = b − origin, w = u × v. Vertices are taken from a
// nearby origin first, which keeps the digits of a polygon that is far from its frame's origin.
template <typename Visit>
void for_each_edge(const Ring& ring, Point origin, Visit visit) {
  if (ring.empty()) return;
  Vector u = ring.back() - origin;
  for (const Point p : ring) {
    const Vector v = p - origin;
    visit(u, v, cross(u, v));
    u = v;
  }
}

template <typename Visit>
void for_each_edge(const Polygon& polygon, Point origin, Visit visit) {
  for_each_edge(polygon.outer, origin, visit);
  for (const Ring& hole : polygon.holes) for_each_edge(hole, origin, visit);
}

double ring_length(const Ring& ring) {
  CompensatedSum sum;
  for_each_edge(ring, Point{}, [&sum](Vector u, Vector v, double) { sum += length(v - u); });
  return sum.total();
}

/// Returns the signed area between an edge and the x axis, of the part below y = `limit`; above it the edge counts as
/// drawn along that line: ∫ min(y, limit) dx along the edge [m²].
double area_below(Point from, Point to, double limit) {
  const double dx = to.x - from.x;
  const double low = std::min(from.y, to.y);
  const double high = std::max(from.y, to.y);
  if (high <= limit) return 0.5 * (low + high) * dx;
  if (low >= limit) return limit * dx;
  const double share = (limit - low) / (high - low);  // of the edge below the limit
  return (share * 0.5 * (low + limit) + (1 - share) * limit) * dx;
}

double ring_area_in_band(const Ring& ring, double half_width) {
  double area = 0;
  for_ring_edges(ring, [&](Point from, Point to) {
    area -= area_below(from, to, half_width) - area_below(from, to, -half_width);
  });
  return area;
}

}  // namespace

Measures measure(const Polygon& polygon) {
  if (polygon.outer.size() < 3) return {};
  const Box box = bounding_box(polygon.outer);
  const Point origin = midpoint(box.low, box.high);
  const Vector size = box.high - box.low;
  Measures result;
  result.area = nearest_area(polygon);
  // The sums below err by some u = 1e-16 of the box's moments for each vertex: they are good as long as the
  // region fills more than a small part of its box. Smaller, moments of slivers are noise; larger, rationals
  // measure floes, a thousand times slower.
  constexpr double kThin = 1e-6;
  if (std::abs(result.area) < kThin * size.x * size.y) return exact_measures(polygon);
  if (result.area == 0) return {0, origin, 0};
  CompensatedSum first_x;
  CompensatedSum first_y;
  for_each_edge(polygon, origin, [&](Vector u, Vector v, double w) {
    first_x += w * (u.x + v.x);
    first_y += w * (u.y + v.y);
  });
  const Vector offset = Vector{first_x.total(), first_y.total()} / (6 * result.area);
  result.centroid = origin + offset;
  CompensatedSum second;  // about the centroid directly: no parallel-axis subtraction
  for_each_edge(polygon, origin, [&](Vector u, Vector v, double) {
    const Vector a = u - offset;
    const Vector b = v - offset;
    second += cross(a, b) * (dot(a, a) + dot(a, b) + dot(b, b));
  });
  result.second_moment = second.total() / 12;
  return result;
}

double perimeter(const Polygon& polygon) {
  double sum = ring_length(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += ring_length(hole);
  return sum;
}

double area_in_band(const Polygon& polygon, double half_width) {
  double area = ring_area_in_band(polygon.outer, half_width);
  for (const Ring& hole : polygon.holes) area += ring_area_in_band(hole, half_width);
  return area;
}

}  // namespace polynya::geometry
