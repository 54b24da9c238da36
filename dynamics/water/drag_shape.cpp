#include "dynamics/water/drag_shape.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/exact/measures.hpp"

namespace polynya::dynamics {

using geometry::Point;
using geometry::Vector;

namespace {

constexpr int kDirections = DragShape::kDirections;
constexpr int kAround = 2 * kDirections;  // the directions of a whole turn; k + kDirections is opposite to k

/// Where a direction is among those of a whole turn, from [0, kAround). The inverse of drag_direction.
double place_around(Vector d) {
  const double t = std::abs(d.y) / (std::abs(d.x) + std::abs(d.y));
  const double half_turn = d.x >= 0 ? t : 2 - t;
  return (d.y >= 0 ? half_turn : 4 - half_turn) * (0.25 * kAround);
}

struct UnitAcross {
  Vector across;     // unit vector, perpendicular to drag_direction(k)
  double share = 0;  // of the mean over directions
};

std::array<UnitAcross, kDirections> make_units() {
  std::array<UnitAcross, kDirections> units;
  for (int k = 0; k < kDirections; ++k) {
    const Vector along = drag_direction(k);
    units[k].across = perpendicular(along) / length(along);
    // The known directions are not evenly spaced in angle: each stands for dθ = |d'| / |d|² of the diamond's
    // edge.
    units[k].share = (2.0 / kDirections) / squared_length(along) / std::numbers::pi;
  }
  return units;
}

const std::array<UnitAcross, kDirections>& units_across() {
  static const std::array<UnitAcross, kDirections> units = make_units();
  return units;
}

/// The unit vector across a direction of a whole turn.
Vector out_at(const std::array<UnitAcross, kDirections>& units, int at) {
  return at < kDirections ? units[at].across : -units[at - kDirections].across;
}

/// A corner is farthest out of a ring only for directions between the normals of its two edges, and of many
/// corners most are for none. Calls use(corner, first, last) with those directions, which may be a turn on.
template <class Use>
void for_outward_corners(std::span<const Point> ring, Use use) {
  constexpr double kSlack = 1e-9;  // of the places, far more than rounding can be
  const std::size_t count = ring.size();
  const auto normal_place = [&](std::size_t i) {  // along, that is: across is a quarter turn on
    return place_around(-(ring[i + 1 < count ? i + 1 : 0] - ring[i]));
  };
  double before = normal_place(count - 1);
  for (std::size_t i = 0; i < count; ++i) {
    const double after = normal_place(i);
    double turn = after - before;
    if (turn < 0) turn += kAround;
    if (turn <= 0.5 * kAround + kSlack || turn >= kAround - kSlack) {  // a corner that points outwards
      const double end = turn >= kAround - kSlack ? before + kSlack : before + turn + kSlack;
      use(ring[i], static_cast<int>(std::ceil(before - kSlack)), static_cast<int>(std::floor(end)));
    }
    before = after;
  }
}

/// How far a ring reaches from a centre within its hull, along the unit vectors across all directions of a
/// whole turn [m].
std::array<double, kAround> reaches(std::span<const Point> ring, Point centre,
                                    const std::array<UnitAcross, kDirections>& units) {
  std::array<double, kAround> reach{};
  for_outward_corners(ring, [&](Point corner, int first, int last) {
    for (int k = first; k <= last; ++k) {
      const int at = (k + kAround) % kAround;
      reach[at] = std::max(reach[at], dot(corner - centre, out_at(units, at)));
    }
  });
  return reach;
}

DragShape edge_shape(const geometry::Polygon& polygon, Point centroid) {
  const std::array<UnitAcross, kDirections>& units = units_across();
  const std::array<double, kAround> reach = reaches(polygon.outer, centroid, units);
  DragShape shape;
  shape.width.resize(kDirections + 1);
  for (int k = 0; k < kDirections; ++k) {
    const double high = reach[k];
    const double low = reach[k + kDirections];
    shape.width[k] = high + low;
    shape.rotational += (low * low * low * low + high * high * high * high) / 4 * units[k].share;
  }
  shape.width[kDirections] = shape.width[0];
  return shape;
}

/// ∫ r³ dA over the triangle of the centre and an edge [m⁵], negative where the edge runs clockwise about it.
/// In polar coordinates about the centre, d from the edge's line and s along it from the nearest point:
/// ∫ r⁵/5 dθ, r = d / cos θ, whose antiderivative is (d s r³/4 + ⅜ d³ s r + ⅜ d⁵ asinh(s/d)) / 5.
double third_moment_of_edge(Vector from, Vector to) {
  const double edge = length(to - from);
  if (edge == 0) return 0;
  const Vector along = (to - from) / edge;
  const double d = cross(from, along);
  if (d == 0) return 0;
  const auto antiderivative = [&](Vector p) {
    const double s = dot(p, along);
    const double r = length(p);
    const double square = d * d;
    return d * (s * r * r * r / 4 + 0.375 * square * (s * r + square * std::asinh(s / std::abs(d)))) / 5;
  };
  return antiderivative(to) - antiderivative(from);
}

double third_moment(const geometry::Ring& ring, Point centroid) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum += third_moment_of_edge(ring[i] - centroid, ring[i + 1 < ring.size() ? i + 1 : 0] - centroid);
  return sum;
}

/// Holes run clockwise.
double third_moment(const geometry::Polygon& polygon, Point centroid) {
  double sum = third_moment(polygon.outer, centroid);
  for (const geometry::Ring& hole : polygon.holes) sum += third_moment(hole, centroid);
  return sum;
}

DragShape plan_shape(const geometry::Polygon& polygon, Point centroid) {
  double area = geometry::signed_area(polygon.outer);
  DragShape shape;
  shape.rotational = third_moment(polygon, centroid);
  for (const geometry::Ring& hole : polygon.holes) area += geometry::signed_area(hole);
  shape.same_width = area;
  shape.is_same = true;
  return shape;
}

}  // namespace

DragShape make_drag_shape(const geometry::Polygon& polygon, Point centroid, DragArea area, bool has_skin) {
  DragShape shape = area == DragArea::kPlan ? plan_shape(polygon, centroid) : edge_shape(polygon, centroid);
  if (has_skin) shape.skin_rotational = area == DragArea::kPlan ? shape.rotational : third_moment(polygon, centroid);
  return shape;
}

DragShape make_small_drag_shape(const geometry::Polygon& polygon, Point centroid, DragArea area, bool has_skin) {
  // Up to here widths_of_outline() costs less than the table takes of memory: 1 kB a floe. No result changes.
  constexpr std::size_t kFewCorners = 32;
  DragShape shape = make_drag_shape(polygon, centroid, area, has_skin);
  if (polygon.outer.size() <= kFewCorners && polygon.holes.empty()) shape.width = std::vector<double>();
  return shape;
}

std::array<double, 2> widths_of_outline(std::span<const Point> corners, Point centroid, int k) {
  const std::array<UnitAcross, kDirections>& units = units_across();
  const int next = (k + 1) % kDirections;
  const std::array<int, 4> places{k, k + kDirections, next, next + kDirections};
  std::array<double, 4> reach{};
  for_outward_corners(corners, [&](Point corner, int first, int last) {
    for (std::size_t i = 0; i < places.size(); ++i) {
      const int at = places[i];
      const bool is_between = (first <= at && at <= last) || (first <= at + kAround && at + kAround <= last);
      if (is_between) reach[i] = std::max(reach[i], dot(corner - centroid, out_at(units, at)));
    }
  });
  return {reach[0] + reach[1], reach[2] + reach[3]};
}

Vector drag_direction(int k) {
  const double t = 2.0 * k / DragShape::kDirections;
  return t < 1 ? Vector{1 - t, t} : Vector{1 - t, 2 - t};
}

}  // namespace polynya::dynamics
