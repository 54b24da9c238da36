#include "dynamics/water_drag.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include <boost/container/small_vector.hpp>

#include "dynamics/chunks.hpp"
#include "geometry/convex_hull.hpp"

namespace polynya::dynamics {

using geometry::Vector;

DragShape make_drag_shape(const geometry::Polygon& polygon, geometry::Point centroid) {
  constexpr std::size_t kFew = 64;  // corners that are not worth a hull
  const bool is_hull_wanted = polygon.outer.size() > kFew;
  const geometry::Ring hull = is_hull_wanted ? geometry::convex_hull(polygon.outer) : geometry::Ring{};
  const geometry::Ring& outline = is_hull_wanted ? hull : polygon.outer;
  DragShape shape;
  for (int k = 0; k < DragShape::kDirections; ++k) {
    const Vector along = drag_direction(k);
    const Vector across = perpendicular(along) / length(along);
    // The known directions are not evenly spaced in angle: each stands for dθ = |d'| / |d|² of the diamond's
    // edge.
    const double share = (2.0 / DragShape::kDirections) / squared_length(along) / std::numbers::pi;
    double low = 0;
    double high = 0;
    for (const geometry::Point p : outline) {
      const double s = dot(p - centroid, across);
      low = std::min(low, s);
      high = std::max(high, s);
    }
    shape.width[k] = high - low;
    shape.rotational += (low * low * low * low + high * high * high * high) / 4 * share;
  }
  shape.width[DragShape::kDirections] = shape.width[0];
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

/// Brakes one body over the step; half_rate is ½ C_D ρ_w Δt. Returns the energy it lost, relative to the
/// water [J].
double brake(Bodies& bodies, BodyIndex i, const DragShape& shape, double half_rate,
             const ShearCurrent& current) {
  const bool is_still = current.is_still();
  const double rate = half_rate * bodies.thickness[i];
  const Vector flow = is_still ? Vector{} : current.velocity_at(bodies.position[i]);
  const Vector u = bodies.velocity[i] - flow;
  const double speed = length(u);
  double lost = 0;
  if (speed > 0) {
    const double width = width_across(shape, rotate_back(bodies.rotation[i], u));
    const double shrink = 1 / (1 + rate * width * bodies.inverse_mass[i] * speed);
    bodies.velocity[i] = flow + shrink * u;
    lost += 0.5 * bodies.mass[i] * speed * speed * (1 - shrink * shrink);
  }
  const double turning = is_still ? 0 : current.angular_velocity();
  const double omega = bodies.angular_velocity[i] - turning;
  if (omega != 0) {
    const double shrink = 1 / (1 + rate * shape.rotational * bodies.inverse_moment[i] * std::abs(omega));
    bodies.angular_velocity[i] = turning + shrink * omega;
    lost += 0.5 * bodies.moment[i] * omega * omega * (1 - shrink * shrink);
  }
  return lost;
}

}  // namespace

double apply_water_drag(Bodies& bodies, const std::vector<BodyIndex>& awake, const WaterDrag& water,
                        double dt, int threads) {
  const double half_rate = 0.5 * water.drag_coefficient * water.density * dt;
  boost::container::small_vector<double, 16> work(chunk_count(awake.size(), kBodiesPerChunk));
  for_chunks(awake.size(), kBodiesPerChunk, threads,
             [&](std::size_t chunk, std::size_t begin, std::size_t end) {
               double lost = 0;
               for (std::size_t k = begin; k < end; ++k) {
                 const DragShape* shape = bodies.drag[awake[k]].get();
                 if (shape != nullptr) lost += brake(bodies, awake[k], *shape, half_rate, water.current);
               }
               work[chunk] = lost;
             });
  return std::accumulate(work.begin(), work.end(), 0.0);
}

}  // namespace polynya::dynamics
