#include "bench/peer.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

#include "simulation/world/world.hpp"

namespace polynya::bench {

using geometry::Point;
using geometry::Rotation;
using geometry::Vector;

namespace {

bool is_convex(const geometry::Ring& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point corner = ring[(i + 1) % ring.size()];
    if (cross(corner - ring[i], ring[(i + 2) % ring.size()] - corner) < -1e-9) return false;
  }
  return true;
}

PeerBody body_at(const simulation::World& world, simulation::BodyIndex i, const geometry::Ring& outline) {
  if (!is_convex(outline)) {
    std::fprintf(stderr, "bench: a body is not convex, the peers could not take it as it is\n");
    std::exit(1);
  }
  const dynamics::Bodies& bodies = world.population.bodies;
  PeerBody body;
  for (const Point p : outline) body.outline.push_back(Point{} + (p - bodies.centroid[i]));
  body.mass = bodies.mass[i];
  body.moment = bodies.moment[i];
  body.position = bodies.position[i];
  body.angle = bodies.angle[i];
  body.velocity = bodies.velocity[i];
  body.angular_velocity = bodies.angular_velocity[i];
  body.is_prescribed = bodies.inverse_mass[i] == 0;
  return body;
}

}  // namespace

PeerScene peer_scene(const simulation::Simulation& simulation) {
  const simulation::World& world = simulation.world();
  PeerScene scene;
  scene.current = world.setup.current;
  scene.friction = world.setup.scene.ice.friction;
  scene.restitution = world.setup.scene.contact.restitution;
  scene.step = world.setup.scene.time.step;
  for (simulation::BodyIndex i = 0; i < world.population.hull_count; ++i) {
    const geometry::Ring& waterline = hull_of(world.setup.scene, i).hull.waterline;
    PeerBody body = body_at(world, i, waterline);
    if (world.population.kind(i) == simulation::BodyKind::kStructure) body.radius = distance(waterline.front(), {});
    if (world.population.kind(i) == simulation::BodyKind::kShip) {
      const simulation::Propulsion& propulsion = world.setup.scene.ships[i].propulsion;
      if (const auto* thrust = std::get_if<simulation::ConstantThrust>(&propulsion)) body.thrust = thrust->thrust;
    }
    scene.bodies.push_back(std::move(body));
  }
  for (std::size_t id = 0; id < world.population.floes.size(); ++id) {
    const auto i = world.population.body_of(static_cast<simulation::FloeId>(id));
    PeerBody body = body_at(world, i, world.population.floes[id].shape.polygon.outer);
    body.drag = 0.5 * world.setup.scene.water.drag_coefficient * world.setup.scene.water.water.density *
                world.population.bodies.thickness[i];
    body.rotational = dynamics::make_drag_shape({body.outline, {}}, {}).rotational;
    for (int k = 0; k < dynamics::DragShape::kDirections; ++k)
      body.widths.push_back(dynamics::widths_of_outline(body.outline, {}, k)[0]);
    body.widths.push_back(body.widths.front());
    scene.bodies.push_back(std::move(body));
  }
  return scene;
}

std::vector<geometry::Ring> convex_pieces(const geometry::Ring& ring, std::size_t most_corners) {
  std::vector<geometry::Ring> pieces;
  for (std::size_t first = 1; first + 1 < ring.size(); first += most_corners - 2) {
    const std::size_t last = std::min(first + most_corners - 2, ring.size() - 1);
    geometry::Ring& piece = pieces.emplace_back();
    piece.push_back(ring[0]);
    for (std::size_t i = first; i <= last; ++i) piece.push_back(ring[i]);
  }
  return pieces;
}

Vector drag_acceleration(const PeerBody& body, const dynamics::ShearCurrent& current, Point p, Vector v, Rotation r) {
  if (body.drag == 0) return {};
  const Vector u = current.is_still() ? v : v - current.velocity_at(p);
  const double speed = length(u);
  if (speed == 0) return {};
  const double place = dynamics::drag_place(rotate_back(r, u));
  const int k = std::min(static_cast<int>(place), dynamics::DragShape::kDirections - 1);
  const double width = body.widths[k] + (place - k) * (body.widths[k + 1] - body.widths[k]);
  return (-body.drag * width * speed / body.mass) * u;
}

double drag_spin(const PeerBody& body, const dynamics::ShearCurrent& current, double angular_velocity) {
  if (body.drag == 0) return 0;
  const double omega = angular_velocity - current.angular_velocity();
  return -body.drag * body.rotational * std::abs(omega) * omega / body.moment;
}

}  // namespace polynya::bench
