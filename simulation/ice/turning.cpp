#include "simulation/ice/turning.hpp"

#include <algorithm>

#include "fracture/turning_cusp.hpp"
#include "geometry/exact/measures.hpp"

namespace polynya::simulation {
namespace {

using geometry::Point;
using geometry::Vector;

/// A piece that turns about the line across `ahead`, a unit vector, through the point of it that is farthest there.
fracture::TurningCusp turning(const geometry::Polygon& piece, Vector ahead) {
  const auto along = [&](Point p) { return dot(p - Point{}, ahead); };
  const auto ends = std::ranges::minmax(piece.outer, {}, along);
  const Point near = ends.min;
  const Point far = ends.max;
  double moment = 0;
  const auto add = [&](const geometry::Ring& ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Vector u = ring[i] - far;
      const Vector v = ring[i + 1 < ring.size() ? i + 1 : 0] - far;
      const double from = dot(u, ahead);
      const double to = dot(v, ahead);
      moment += cross(u, v) * (from * from + from * to + to * to) / 12;
    }
  };
  add(piece.outer);
  for (const geometry::Ring& hole : piece.holes) add(hole);
  return {geometry::measure(piece).area, along(far) - along(near), moment};
}

/// What the cut's cusps weigh at the edge that the hull presses down [kg].
double pressed_mass(const Setup& setup, const Population& population, const PendingFracture& bend,
                    const geometry::CutResult& cut) {
  const BodyIndex body = population.body_of(bend.floe);
  const Vector ahead = rotate_back(population.bodies.rotation[body], bend.normal);
  double mass = 0;
  for (const geometry::Piece& piece : cut.pieces) {
    if (piece.part != geometry::Part::kInside) continue;
    mass += fracture::edge_mass(ice_of_floe(setup, population, bend.floe), setup.scene.water.water,
                                turning(piece.shape.polygon, ahead));
  }
  return mass;
}

}  // namespace

void turn_cusp(const Setup& setup, const PendingFracture& bend, const geometry::CutResult& cut, Population& population,
               ShipLoads& loads, AuditSums& audit) {
  const EdgePush& push = bend.push;
  const BodyIndex ship = bend.ship;
  const bool goes_under = setup.scene.fracture.cusp_fate == CuspFate::kUnderHull && setup.underwater[ship].can_take_ice;
  if (push.speed <= 0 || !goes_under) return;
  dynamics::Bodies& bodies = population.bodies;
  const Vector arm = bend.point_in_water - bodies.position[ship];
  const double mass = pressed_mass(setup, population, bend, cut);
  // The hull slows down by what it gives: the two move on together.
  const auto slowed = [&](Vector impulse) {
    return push.speed_per_approach *
           dot(bend.normal,
               bodies.inverse_mass[ship] * impulse + cross(bodies.inverse_moment[ship] * cross(arm, impulse), arm));
  };
  const double given = mass * push.speed / (1 + mass * std::max(0.0, slowed(push.horizontal)));  // down on the edge
  const Vector impulse = -given * push.horizontal;
  const double turned = cross(arm, impulse);
  const Vector in_ship = rotate_back(bodies.rotation[ship], impulse);
  loads.submerged.impulse += {in_ship.x, in_ship.y, turned};
  if (bodies.inverse_mass[ship] == 0) return;
  const Vector change = bodies.inverse_mass[ship] * impulse;
  const double spin = bodies.inverse_moment[ship] * turned;
  audit.energy.submersion -=
      dot(impulse, bodies.velocity[ship] + 0.5 * change) + turned * (bodies.angular_velocity[ship] + 0.5 * spin);
  audit.momentum.water += impulse;
  audit.impulses += length(impulse);
  bodies.velocity[ship] += change;
  bodies.angular_velocity[ship] += spin;
}

}  // namespace polynya::simulation
