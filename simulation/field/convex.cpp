#include "simulation/field/convex.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/segments.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Ring;
using geometry::Vector;

/// Returns the area of the triangle that is lost if corner i is removed [m²].
double corner_area(const Ring& ring, std::size_t i) {
  const std::size_t n = ring.size();
  return 0.5 * cross(ring[i] - ring[(i + n - 1) % n], ring[(i + 1) % n] - ring[i]);
}

/// Keeps the part of a ring where dot(normal, x − origin) ≥ offset.
void clip_beyond(Ring& ring, Point origin, Vector normal, double offset) {
  Ring left;
  left.reserve(ring.size() + 1);
  Point previous = ring.back();
  double before = dot(normal, previous - origin) - offset;
  for (const Point p : ring) {
    const double side = dot(normal, p - origin) - offset;
    if ((side < 0) != (before < 0)) left.push_back(previous + (before / (before - side)) * (p - previous));
    if (side >= 0) left.push_back(p);
    previous = p;
    before = side;
  }
  if (left.size() < 3) left.clear();
  ring = std::move(left);
}

}  // namespace

CellMeasures measure_convex(const Ring& ring) {
  double twice_area = 0;
  Vector moment;
  for (std::size_t i = 2; i < ring.size(); ++i) {
    const Vector p = ring[i - 1] - ring[0];
    const Vector q = ring[i] - ring[0];
    const double part = cross(p, q);
    twice_area += part;
    moment += part * (p + q);
  }
  if (!(twice_area > 0)) return {};
  return {0.5 * twice_area, ring[0] + moment / (3 * twice_area)};
}

double aspect_of(const Ring& ring) {
  const CellMeasures cell = measure_convex(ring);
  double xx = 0;
  double yy = 0;
  double xy = 0;
  for_ring_edges(ring, [&](Point from, Point to) {
    const Vector p = from - cell.centroid;
    const Vector q = to - cell.centroid;
    const double part = cross(p, q);
    xx += part * (p.x * p.x + p.x * q.x + q.x * q.x);
    yy += part * (p.y * p.y + p.y * q.y + q.y * q.y);
    xy += part * (p.x * p.y + 0.5 * (p.x * q.y + q.x * p.y) + q.x * q.y);
  });
  const double mean = 0.5 * (xx + yy);
  const double half = std::sqrt(0.25 * (xx - yy) * (xx - yy) + xy * xy);
  return mean > half ? std::sqrt((mean + half) / (mean - half)) : INFINITY;
}

void clip_to_left(Ring& ring, Point from, Point to) {
  clip_beyond(ring, from, perpendicular(to - from), 0);
}

Ring inset(const Ring& ring, double distance) {
  Ring left = ring;
  for_ring_edges(ring, [&](Point from, Point to) {
    const Vector edge = to - from;
    if (!left.empty()) clip_beyond(left, from, perpendicular(edge), distance * length(edge));
  });
  return left;
}

Ring scaled(const Ring& ring, Point centre, double factor) {
  Ring moved;
  moved.reserve(ring.size());
  for (const Point p : ring) moved.push_back(centre + factor * (p - centre));
  return moved;
}

void reduce_corners(Ring& ring, int most, double shortest) {
  while (ring.size() > 3) {
    const std::size_t n = ring.size();
    std::size_t least = n;
    const auto consider = [&](std::size_t i) {
      if (least == n || corner_area(ring, i) < corner_area(ring, least)) least = i;
    };
    for (std::size_t i = 0; i < n; ++i) {
      if (distance(ring[i], ring[(i + 1) % n]) >= shortest) continue;
      consider(i);
      consider((i + 1) % n);
    }
    if (least == n && n > static_cast<std::size_t>(most)) {
      for (std::size_t i = 0; i < n; ++i) consider(i);
    }
    if (least == n) return;
    ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(least));
  }
}

void add_corners(Ring& ring, int least) {
  constexpr double kCutOff = 0.3;  // length of the cut along either edge, as a fraction of the shorter one [-]
  for (std::size_t n = ring.size(); n >= 3 && n < static_cast<std::size_t>(least); n = ring.size()) {
    std::size_t sharpest = 0;
    double most = -2;
    for (std::size_t i = 0; i < n; ++i) {
      const Vector back = ring[(i + n - 1) % n] - ring[i];
      const Vector ahead = ring[(i + 1) % n] - ring[i];
      const double cosine = dot(back, ahead) / (length(back) * length(ahead));
      if (cosine > most) {
        most = cosine;
        sharpest = i;
      }
    }
    const Point corner = ring[sharpest];
    const Vector back = ring[(sharpest + n - 1) % n] - corner;
    const Vector ahead = ring[(sharpest + 1) % n] - corner;
    const double cut = kCutOff * std::min(length(back), length(ahead));
    ring[sharpest] = corner + (cut / length(back)) * back;
    ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(sharpest) + 1, corner + (cut / length(ahead)) * ahead);
  }
}

std::vector<Ring> strips_of(const Ring& ring, Vector direction, const std::vector<double>& shares) {
  std::vector<Ring> strips;
  const CellMeasures cell = measure_convex(ring);
  double sum = 0;
  for (const double share : shares) sum += share;
  double first = 0;
  for (const Point p : ring) first = std::min(first, dot(direction, p - cell.centroid));
  Ring rest = ring;
  for (std::size_t k = 0; k + 1 < shares.size() && !rest.empty(); ++k) {
    double low = first;
    double high = 0;
    for (const Point p : ring) high = std::max(high, dot(direction, p - cell.centroid));
    const double wanted = measure_convex(rest).area - cell.area * shares[k] / sum;
    for (int i = 0; i < 48; ++i) {
      const double middle = 0.5 * (low + high);
      Ring beyond = rest;
      clip_beyond(beyond, cell.centroid, direction, middle);
      const double area = beyond.empty() ? 0 : measure_convex(beyond).area;
      (area > wanted ? low : high) = middle;
    }
    Ring strip = rest;
    clip_beyond(strip, cell.centroid, -direction, -low);
    clip_beyond(rest, cell.centroid, direction, low);
    strips.push_back(std::move(strip));
    first = low;
  }
  strips.resize(shares.size() - 1);
  strips.push_back(std::move(rest));
  return strips;
}

bool is_near_ring(const Ring& floe, const Ring& ring, double gap) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point a = ring[i];
    const Point b = ring[(i + 1) % ring.size()];
    for (std::size_t k = 0; k < floe.size(); ++k) {
      const Point c = floe[k];
      const Point d = floe[(k + 1) % floe.size()];
      if (squared_distance_of_ends(a, b, c, d) < gap * gap || cross_each_other(a, b, c, d)) return true;
    }
  }
  return false;
}

}  // namespace polynya::simulation
