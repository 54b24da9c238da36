#include "geometry/exact/internal/nearest_area.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/exact/exact_area.hpp"
#include "geometry/exact/internal/error_free.hpp"

namespace polynya::geometry {
namespace {

constexpr double kUnit = std::numeric_limits<double>::epsilon() / 2;  // of rounding, u

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

// A coordinate difference: high + low exactly, and high in halves.
struct Difference {
  Difference(double a, double b) : both(two_difference(a, b)), halves(both.high) {}
  TwoDoubles both;
  SplitDouble halves;
};

// Shoelace sum about the first vertex, in twice the digits of a double: products and sums keep their errors,
// which go to `low`. With R the product of the farthest |x| and |y| and V the largest partial sum, one edge
// adds at most u(8R + V) to `low`, and what adding that up n times loses, with the products of two tails, is
// below (n + 8)²u²(8R + V).
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
  constexpr double kUnderflow = 1e-300;  // of one edge's products, and more
  const double edges = static_cast<double>(ring.size()) + 8;
  const double steps = edges * kUnit;
  sum.doubt = 2 * steps * steps * (8 * reach_x * reach_y + largest) + edges * kUnderflow;
  return sum;
}

// Half of it as the nearest double, where the doubt leaves no other.
bool is_nearest(const TwiceArea& twice, double& area) {
  const TwoDoubles sum = two_sum(twice.value, twice.low);
  const double gap = std::abs(sum.high) - std::nextafter(std::abs(sum.high), 0);  // to the closer neighbour
  area = sum.high / 2;
  return std::abs(sum.low) + twice.doubt < gap / 2;
}

}  // namespace

double nearest_area(const Ring& ring) {
  double area = 0;
  return is_nearest(twice_area(ring), area) ? area : exact_area({ring, {}});
}

double nearest_area(const Polygon& polygon) {
  TwiceArea sum = twice_area(polygon.outer);
  for (const Ring& hole : polygon.holes) sum += twice_area(hole);
  double area = 0;
  return is_nearest(sum, area) ? area : exact_area(polygon);
}

}  // namespace polynya::geometry
