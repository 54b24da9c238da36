#include "dynamics/water_drag.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <boost/container/small_vector.hpp>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {

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

/// How far a ring reaches from a centre within its hull, along the unit vectors across all directions of a
/// whole turn [m]. A corner is farthest out only for directions between the normals of its two edges, so each
/// is measured along those alone, and of many corners most along none.
std::array<double, kAround> reaches(const geometry::Ring& ring, geometry::Point centre,
                                    const std::array<UnitAcross, kDirections>& units) {
  constexpr double kSlack = 1e-9;  // of the places, far more than rounding can be
  std::array<double, kAround> reach{};
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
      for (int k = static_cast<int>(std::ceil(before - kSlack)); k <= end; ++k) {
        const int at = (k + kAround) % kAround;
        const Vector out = at < kDirections ? units[at].across : -units[at - kDirections].across;
        reach[at] = std::max(reach[at], dot(ring[i] - centre, out));
      }
    }
    before = after;
  }
  return reach;
}

}  // namespace

DragShape make_drag_shape(const geometry::Polygon& polygon, geometry::Point centroid) {
  static const std::array<UnitAcross, kDirections> units = make_units();
  const std::array<double, kAround> reach = reaches(polygon.outer, centroid, units);
  DragShape shape;
  for (int k = 0; k < kDirections; ++k) {
    const double high = reach[k];
    const double low = reach[k + kDirections];
    shape.width[k] = high + low;
    shape.rotational += (low * low * low * low + high * high * high * high) / 4 * units[k].share;
  }
  shape.width[kDirections] = shape.width[0];
  return shape;
}

Vector drag_direction(int k) {
  const double t = 2.0 * k / DragShape::kDirections;
  return t < 1 ? Vector{1 - t, t} : Vector{1 - t, 2 - t};
}

double width_across(const DragShape& shape, Vector direction_in_body) {
  Vector d = direction_in_body;
  if (d.y < 0) d = -d;
  const double from_axis = d.y / (std::abs(d.x) + d.y);
  const double t = d.x >= 0 ? from_axis : 2 - from_axis;
  const double at = t * (0.5 * DragShape::kDirections);
  const int k = std::min(static_cast<int>(at), DragShape::kDirections - 1);
  return shape.width[k] + (at - k) * (shape.width[k + 1] - shape.width[k]);
}

namespace {

/// Brakes one body over the step; half_rate is ½ C_D ρ_w Δt.
void brake(Bodies& bodies, BodyIndex i, const DragShape& shape, double half_rate, const ShearCurrent& current,
           WaterWork& work) {
  const bool is_still = current.is_still();
  const double rate = half_rate * bodies.thickness[i];
  const Vector flow = is_still ? Vector{} : current.velocity_at(bodies.position[i]);
  const Vector u = bodies.velocity[i] - flow;
  const double speed = length(u);
  if (speed > 0) {
    const double width = width_across(shape, rotate_back(bodies.rotation[i], u));
    const double shrink = 1 / (1 + rate * width * bodies.inverse_mass[i] * speed);
    bodies.velocity[i] = flow + shrink * u;
    const double slowing = bodies.mass[i] * (1 - shrink);
    const Vector impulse = -slowing * u;
    work.lost += 0.5 * slowing * (1 + shrink) * speed * speed;
    work.impulse += impulse;
    work.impulses += slowing * speed;
    if (!is_still) work.by_current += dot(impulse, flow);
  }
  const double turning = is_still ? 0 : current.angular_velocity();
  const double omega = bodies.angular_velocity[i] - turning;
  if (omega != 0) {
    const double shrink = 1 / (1 + rate * shape.rotational * bodies.inverse_moment[i] * std::abs(omega));
    bodies.angular_velocity[i] = turning + shrink * omega;
    const double slowing = bodies.moment[i] * (1 - shrink) * omega;
    work.lost += 0.5 * slowing * (1 + shrink) * omega;
    work.by_current -= slowing * turning;
  }
}

}  // namespace

WaterWork apply_water_drag(Bodies& bodies, const std::vector<BodyIndex>& awake, const WaterDrag& water,
                           double dt, int threads) {
  const double half_rate = 0.5 * water.drag_coefficient * water.density * dt;
  boost::container::small_vector<WaterWork, 16> works(chunk_count(awake.size(), kBodiesPerChunk));
  for_chunks(awake.size(), kBodiesPerChunk, threads,
             [&](std::size_t chunk, std::size_t begin, std::size_t end) {
               WaterWork work;
               for (std::size_t k = begin; k < end; ++k) {
                 const DragShape* shape = bodies.drag[awake[k]].get();
                 if (shape != nullptr) brake(bodies, awake[k], *shape, half_rate, water.current, work);
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
