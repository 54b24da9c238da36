#include "dynamics/water/water_drag.hpp"

#include <algorithm>
#include <numbers>

#include <boost/container/small_vector.hpp>

#include "dynamics/chunks.hpp"
#include "elementary/elementary.hpp"
#include "geometry/exact/measures.hpp"
#include "geometry/shape/avx2_clone.hpp"

namespace polynya::dynamics {

using geometry::Point;
using geometry::Vector;

// ---- drag shapes

namespace {

constexpr int kDirections = DragShape::kDirections;
constexpr int kAround = 2 * kDirections;  // directions of a whole turn; k + kDirections is opposite to k

/// Returns drag_place() among the directions of a whole turn, in [0, kAround).
double place_around(Vector d) {
  return d.y >= 0 ? drag_place(d) : kAround - drag_place({d.x, -d.y});
}

struct UnitAcross {
  Vector across;     // unit vector, perpendicular to drag_direction(k)
  double share = 0;  // weight in the mean over directions
};

std::array<UnitAcross, kDirections> make_units() {
  std::array<UnitAcross, kDirections> units;
  for (int k = 0; k < kDirections; ++k) {
    const Vector along = drag_direction(k);
    units[k].across = perpendicular(along) / length(along);
    // The directions are not evenly spaced in angle: each represents dθ = |d'| / |d|² of the diamond's edge.
    units[k].share = (2.0 / kDirections) / squared_length(along) / std::numbers::pi;
  }
  return units;
}

const std::array<UnitAcross, kDirections>& units_across() {
  static const std::array<UnitAcross, kDirections> units = make_units();
  return units;
}

/// Returns the unit vector across a direction of a whole turn.
Vector out_at(const std::array<UnitAcross, kDirections>& units, int at) {
  return at < kDirections ? units[at].across : -units[at - kDirections].across;
}

/// Calls use(corner, first, last) for each corner and the directions in which it is the farthest one of the ring. These
/// are the directions between the normals of its two edges; most of many corners have none. `last` may be one turn on.
template <class Use>
void for_outward_corners(std::span<const Point> ring, Use use) {
  constexpr double kSlack = 1e-9;  // in directions, far more than rounding errors
  const std::size_t count = ring.size();
  const auto normal_place = [&](std::size_t i) {  // along the edge: `across` is a quarter turn further
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

/// Returns how far a ring reaches from a centre within its convex hull, along the unit vectors across all directions of
/// a whole turn [m].
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
  for (int k = 0; k < kDirections; ++k) {
    const double high = reach[k];
    const double low = reach[k + kDirections];
    shape.rotational += (low * low * low * low + high * high * high * high) / 4 * units[k].share;
  }
  return shape;
}

/// Returns ∫ r³ dA over the triangle of the centre and an edge [m⁵]; negative if the edge runs clockwise about the
/// centre. In polar coordinates about the centre, with the distance d of the edge's line and s along it from the
/// nearest point, the integral is ∫ r⁵/5 dθ with r = d / cos θ. Its antiderivative is (d s r³/4 + ⅜ d³ s r + ⅜ d⁵
/// asinh(s/d)) / 5.
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
    return d * (s * r * r * r / 4 + 0.375 * square * (s * r + square * elementary::asinh(s / std::abs(d)))) / 5;
  };
  return antiderivative(to) - antiderivative(from);
}

double third_moment(const geometry::Ring& ring, Point centroid) {
  double sum = 0;
  for_ring_edges(ring, [&](Point from, Point to) { sum += third_moment_of_edge(from - centroid, to - centroid); });
  return sum;
}

/// Returns ∫ r³ dA of a polygon about its centroid [m⁵]. Holes run clockwise.
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
  return shape;
}

}  // namespace

DragShape make_drag_shape(const geometry::Polygon& polygon, Point centroid, DragArea area, bool has_skin) {
  DragShape shape = area == DragArea::kPlan ? plan_shape(polygon, centroid) : edge_shape(polygon, centroid);
  if (has_skin) shape.skin_rotational = area == DragArea::kPlan ? shape.rotational : third_moment(polygon, centroid);
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

// ---- forces on bodies

namespace {

/// Some bodies side by side, for loops that the compiler turns into vector instructions. The arrays are plain, because
/// the compiler does not vectorise arrays that check their indices.
struct Lanes {
  // This number keeps the arrays in the first cache. Results do not depend on it.
  static constexpr std::size_t kMost = 32;
  std::size_t count = 0;  ///< number of bodies in the lanes
  BodyIndex body[kMost];
  // Motion through the water, and the values that change it.
  double ux[kMost], uy[kMost], speed[kMost], cosine[kMost], sine[kMost], place[kMost], width[kMost];
  double rate[kMost], skin[kMost], skin_turning[kMost], inverse_mass[kMost], mass[kMost];
  double omega[kMost], rotational[kMost], inverse_moment[kMost], moment[kMost];
  // Motion after the step, relative to the water.
  double ux_after[kMost], uy_after[kMost], omega_after[kMost];
  // Work and impulses of the water.
  double slowing[kMost], lost[kMost], lost_turning[kMost], turning_slowing[kMost];
};

POLYNYA_AVX2_CLONE void find_places(Lanes& l, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    l.speed[i] = std::sqrt(l.ux[i] * l.ux[i] + l.uy[i] * l.uy[i]);
    const double x = l.cosine[i] * l.ux[i] + l.sine[i] * l.uy[i];
    const double y = -l.sine[i] * l.ux[i] + l.cosine[i] * l.uy[i];
    const double place = drag_place({x, y});
    l.place[i] = l.speed[i] > 0 ? place : 0;
  }
}

POLYNYA_AVX2_CLONE void brake(Lanes& l, std::size_t count) {
  for (std::size_t i = 0; i < count; ++i) {
    const double shrink = 1 / (1 + (l.rate[i] * l.width[i] + l.skin[i]) * l.inverse_mass[i] * l.speed[i]);
    l.ux_after[i] = shrink * l.ux[i];
    l.uy_after[i] = shrink * l.uy[i];
    l.slowing[i] = l.mass[i] * (1 - shrink);
    l.lost[i] = 0.5 * l.slowing[i] * (1 + shrink) * l.speed[i] * l.speed[i];
  }
  for (std::size_t i = 0; i < count; ++i) {
    const double rate = l.rate[i] * l.rotational[i] + l.skin_turning[i];
    const double shrink = 1 / (1 + rate * l.inverse_moment[i] * std::abs(l.omega[i]));
    l.omega_after[i] = shrink * l.omega[i];
    l.turning_slowing[i] = l.moment[i] * (1 - shrink) * l.omega[i];
    l.lost_turning[i] = 0.5 * l.turning_slowing[i] * (1 + shrink) * l.omega[i];
  }
}

/// The columns of the bodies that drag reads and changes, without checks of each index.
struct Columns {
  explicit Columns(Bodies& bodies)
      : position(bodies.position.data()),
        rotation(bodies.rotation.data()),
        velocity(bodies.velocity.data()),
        angular_velocity(bodies.angular_velocity.data()),
        mass(bodies.mass.data()),
        inverse_mass(bodies.inverse_mass.data()),
        moment(bodies.moment.data()),
        inverse_moment(bodies.inverse_moment.data()),
        thickness(bodies.thickness.data()),
        area(bodies.area.data()),
        span(bodies.drag_span.data()),
        drag(bodies.drag.data()),
        centroid(bodies.centroid.data()),
        boundary(bodies.boundary.data()) {}

  const geometry::Point* position;
  const geometry::Rotation* rotation;
  Vector* velocity;
  double* angular_velocity;
  const double *mass, *inverse_mass, *moment, *inverse_moment, *thickness, *area;
  DragSpan* span;
  const std::shared_ptr<const DragShape>* drag;
  const geometry::Point* centroid;
  const std::shared_ptr<geometry::Boundary>* boundary;
};

/// Returns the widths across the k-th direction and the next one.
DragSpan span_at(const Columns& bodies, BodyIndex i, int k) {
  const DragShape& shape = *bodies.drag[i];
  if (shape.same_width) return {*shape.same_width, *shape.same_width, shape.rotational, k};
  const auto [width, next_width] = widths_of_outline(bodies.boundary[i]->edges.outer_corners(), bodies.centroid[i], k);
  return {width, next_width, shape.rotational, k};
}

/// Returns the width across a place between two known directions.
double width_at(const Columns& bodies, BodyIndex i, double place) {
  DragSpan& span = bodies.span[i];
  const int k = std::min(static_cast<int>(place), DragShape::kDirections - 1);
  if (span.place != k) span = span_at(bodies, i, k);
  return span.width + (place - k) * (span.next_width - span.width);
}

Vector flow_at(const Columns& bodies, BodyIndex i, const ShearCurrent& current) {
  return current.is_still() ? Vector{} : current.velocity_at(bodies.position[i]);
}

/// ½ C ρ_w Δt of a step.
struct DragRates {
  double form = 0, skin = 0;  ///< [kg/m³ · s]
  bool is_plan = false;
};

/// Writes the values that change the motion of the bodies into the lanes.
void gather(const Columns& bodies, Lanes& l, std::size_t count, const DragRates& rates, const ShearCurrent& current) {
  const double turning = current.is_still() ? 0 : current.angular_velocity();
  for (std::size_t k = 0; k < count; ++k) {
    const BodyIndex i = l.body[k];
    const Vector u = bodies.velocity[i] - flow_at(bodies, i, current);
    l.ux[k] = u.x;
    l.uy[k] = u.y;
    l.cosine[k] = bodies.rotation[i].cosine;
    l.sine[k] = bodies.rotation[i].sine;
    l.rate[k] = rates.is_plan ? rates.form : rates.form * bodies.thickness[i];
    l.skin[k] = rates.skin * bodies.area[i];
    l.skin_turning[k] = rates.skin > 0 ? rates.skin * bodies.drag[i]->skin_rotational : 0;
    l.inverse_mass[k] = bodies.inverse_mass[i];
    l.mass[k] = bodies.mass[i];
    l.omega[k] = bodies.angular_velocity[i] - turning;
    l.inverse_moment[k] = bodies.inverse_moment[i];
    l.moment[k] = bodies.moment[i];
  }
}

/// Writes the motion of the lanes back, and adds the work of the water body by body.
void scatter(const Columns& bodies, const Lanes& l, std::size_t count, const ShearCurrent& current, WaterWork& work) {
  const bool is_still = current.is_still();
  const double turning = is_still ? 0 : current.angular_velocity();
  for (std::size_t k = 0; k < count; ++k) {
    const BodyIndex i = l.body[k];
    if (l.speed[k] > 0) {
      const Vector flow = flow_at(bodies, i, current);
      const Vector impulse = -l.slowing[k] * Vector{l.ux[k], l.uy[k]};
      bodies.velocity[i] = flow + Vector{l.ux_after[k], l.uy_after[k]};
      work.lost += l.lost[k];
      work.impulse += impulse;
      work.impulses += l.slowing[k] * l.speed[k];
      if (!is_still) work.by_current += dot(impulse, flow);
    }
    if (l.omega[k] != 0) {
      bodies.angular_velocity[i] = turning + l.omega_after[k];
      work.lost += l.lost_turning[k];
      work.by_current -= l.turning_slowing[k] * turning;
    }
  }
}

/// Brakes the bodies of the lanes over the step.
void brake(const Columns& bodies, Lanes& l, const WaterDrag& water, double dt, WaterWork& work) {
  const std::size_t count = l.count;
  const DragRates rates{0.5 * water.drag_coefficient * water.density * dt,
                        0.5 * water.skin_coefficient * water.density * dt, water.area == DragArea::kPlan};
  gather(bodies, l, count, rates, water.current);
  find_places(l, count);
  for (std::size_t k = 0; k < count; ++k) {
    l.width[k] = width_at(bodies, l.body[k], l.place[k]);
    l.rotational[k] = bodies.span[l.body[k]].rotational;
  }
  brake(l, count);
  scatter(bodies, l, count, water.current, work);
}

}  // namespace

WaterWork apply_water_drag(Bodies& bodies, const std::vector<BodyIndex>& awake, const WaterDrag& water, double dt,
                           int threads) {
  const Columns columns(bodies);
  boost::container::small_vector<WaterWork, 16> works(chunk_count(awake.size(), kBodiesPerChunk));
  for_chunks(awake.size(), kBodiesPerChunk, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    WaterWork work;
    Lanes lanes;
    for (std::size_t k = begin; k < end; ++k) {
      if (columns.span[awake[k]].place >= 0 || columns.drag[awake[k]] != nullptr) lanes.body[lanes.count++] = awake[k];
      if (lanes.count < Lanes::kMost && k + 1 < end) continue;
      brake(columns, lanes, water, dt, work);
      lanes.count = 0;
    }
    works[chunk] = work;
  });
  WaterWork all;
  for (const WaterWork& work : works) {
    all.lost += work.lost;
    all.by_current += work.by_current;
    all.impulse += work.impulse;
    all.impulses += work.impulses;
  }
  return all;
}

}  // namespace polynya::dynamics
