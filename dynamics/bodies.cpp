#include "dynamics/bodies.hpp"

#include <algorithm>
#include <cassert>

namespace polynya::dynamics {

BodyIndex add_body(Bodies& bodies, const NewBody& body) {
  assert(body.mass > 0 && body.moment > 0 && body.boundary);
  double radius = 0;
  for (const geometry::Point p : body.boundary->edges.vertices) radius = std::max(radius, distance(p, body.centroid));
  bodies.position.push_back(body.position);
  bodies.angle.push_back(body.angle);
  bodies.rotation.push_back(geometry::Rotation::by(body.angle));
  bodies.velocity.push_back(body.velocity);
  bodies.angular_velocity.push_back(body.angular_velocity);
  bodies.inverse_mass.push_back(body.is_held ? 0 : 1 / body.mass);
  bodies.inverse_moment.push_back(body.is_held ? 0 : 1 / body.moment);
  bodies.travel.push_back(0);
  bodies.bounding_radius.push_back(radius);
  bodies.is_awake.push_back(0);
  bodies.is_alive.push_back(1);
  bodies.mass.push_back(body.mass);
  bodies.moment.push_back(body.moment);
  bodies.centroid.push_back(body.centroid);
  bodies.thickness.push_back(body.thickness);
  bodies.boundary.push_back(body.boundary);
  bodies.drag.push_back(body.drag);
  return bodies.size() - 1;
}

void integrate(Bodies& bodies, const std::vector<BodyIndex>& awake, double dt) {
  for (const BodyIndex i : awake) {
    const geometry::Vector velocity = bodies.velocity[i];
    const double omega = bodies.angular_velocity[i];
    bodies.position[i] += dt * velocity;
    bodies.angle[i] += dt * omega;
    bodies.rotation[i] = geometry::Rotation::by(bodies.angle[i]);
    bodies.travel[i] += dt * (length(velocity) + std::abs(omega) * bodies.bounding_radius[i]);
  }
}

}  // namespace polynya::dynamics
