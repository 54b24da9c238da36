#include "dynamics/bodies.hpp"

#include <algorithm>
#include <cassert>
#include <span>

#include <boost/container/small_vector.hpp>

#include "dynamics/chunks.hpp"

namespace polynya::dynamics {

BodyIndex add_body(Bodies& bodies, const NewBody& body) {
  assert(body.mass > 0 && body.moment > 0 && body.boundary);
  const geometry::EdgeList& edges = body.boundary->edges;
  double radius = 0;
  double area = 0;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge)
    area += 0.5 * cross(edges.from(edge) - body.centroid, edges.to(edge) - body.centroid);
  for (const geometry::Point p : edges.vertices) radius = std::max(radius, distance(p, body.centroid));
  bodies.position.push_back(body.position);
  bodies.angle.push_back(body.angle);
  bodies.angle_rest.push_back(0);
  bodies.rotation.push_back(geometry::Rotation::by(body.angle));
  bodies.velocity.push_back(body.velocity);
  bodies.angular_velocity.push_back(body.angular_velocity);
  bodies.inverse_mass.push_back(body.is_prescribed ? 0 : 1 / body.mass);
  bodies.inverse_moment.push_back(body.is_prescribed ? 0 : 1 / body.moment);
  bodies.travel.push_back(0);
  bodies.bounding_radius.push_back(radius);
  bodies.rim_speed.push_back(length(body.velocity) + std::abs(body.angular_velocity) * radius);
  bodies.drag_span.push_back({});
  bodies.is_awake.push_back(0);
  bodies.is_alive.push_back(1);
  bodies.mass.push_back(body.mass);
  bodies.moment.push_back(body.moment);
  bodies.centroid.push_back(body.centroid);
  bodies.area.push_back(area);
  bodies.thickness.push_back(body.thickness);
  bodies.kind.push_back(body.kind);
  bodies.boundary.push_back(body.boundary);
  bodies.drag.push_back(body.drag);
  return bodies.size() - 1;
}

void reserve(Bodies& bodies, std::size_t count) {
  const auto reserve_all = [count](auto&... columns) { (columns.reserve(count), ...); };
  reserve_all(bodies.position, bodies.angle, bodies.angle_rest, bodies.rotation, bodies.velocity,
              bodies.angular_velocity, bodies.inverse_mass, bodies.inverse_moment, bodies.travel,
              bodies.bounding_radius, bodies.rim_speed, bodies.drag_span, bodies.is_awake, bodies.is_alive, bodies.mass,
              bodies.moment, bodies.centroid, bodies.area, bodies.thickness, bodies.kind, bodies.boundary, bodies.drag);
}

void move_body(Bodies& bodies, BodyIndex i, geometry::Vector shift, double turn) {
  bodies.position[i] += shift;
  bodies.travel[i] += length(shift) + std::abs(turn) * bodies.bounding_radius[i];
  if (turn == 0) return;
  turn_body(bodies, i, turn);
}

double integrate(Bodies& bodies, const std::vector<BodyIndex>& awake, double dt, int threads) {
  boost::container::small_vector<double, 16> fastest(chunk_count(awake.size(), kBodiesPerChunk));
  const auto is_faster = [](double rim, double than) { return rim > than || rim != rim; };
  for_chunks(awake.size(), kBodiesPerChunk, threads, [&](std::size_t chunk, std::size_t begin, std::size_t end) {
    // Pointers avoid the checks of each index.
    const geometry::Vector* velocity = bodies.velocity.data();
    const double* angular_velocity = bodies.angular_velocity.data();
    const double* radius = bodies.bounding_radius.data();
    geometry::Point* position = bodies.position.data();
    double* travel = bodies.travel.data();
    double* rim_speed = bodies.rim_speed.data();
    double most = 0;
    for (const BodyIndex i : std::span(awake).subspan(begin, end - begin)) {
      const double omega = angular_velocity[i];
      const double rim = length(velocity[i]) + std::abs(omega) * radius[i];
      rim_speed[i] = rim;
      if (is_faster(rim, most)) most = rim;
      position[i] += dt * velocity[i];
      travel[i] += dt * rim;
      if (omega != 0) turn_body(bodies, i, dt * omega);
    }
    fastest[chunk] = most;
  });
  double most = 0;
  for (const double rim : fastest) {
    if (is_faster(rim, most)) most = rim;
  }
  return most;
}

}  // namespace polynya::dynamics
