#include "geometry/exact/internal/exact_moments.hpp"

#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {
namespace {

using exact::Rational;

// Integrals over a region: of 1, of the position and of its square, each by a factor that Green's theorem
// leaves.
struct Moments {
  Rational twice_area = 0;
  Rational six_first_x = 0;
  Rational six_first_y = 0;
  Rational twelve_second = 0;
};

// About the frame's origin: rationals lose no digits far from it.
void add(Moments& moments, const Ring& ring) {
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

}  // namespace

Measures exact_measures(const Polygon& polygon) {
  Moments moments;
  add(moments, polygon.outer);
  for (const Ring& hole : polygon.holes) add(moments, hole);
  if (moments.twice_area == 0) return {0, polygon.outer.front(), 0};
  const Rational area = moments.twice_area / 2;
  const exact::Point centroid{moments.six_first_x / (6 * area), moments.six_first_y / (6 * area)};
  const Rational second =
      moments.twelve_second / 12 - area * (centroid.x * centroid.x + centroid.y * centroid.y);
  return {exact::nearest_double(area), exact::rounded(centroid), exact::nearest_double(second)};
}

}  // namespace polynya::geometry
