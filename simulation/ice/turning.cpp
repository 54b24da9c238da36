#include "simulation/ice/turning.hpp"

#include <algorithm>

#include "fracture/beam.hpp"
#include "fracture/turning_cusp.hpp"

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
  const geometry::Rotation ahead_from_body{ahead.x, -ahead.y};
  const fracture::PlaneMoments moments =
      fracture::moments_of(piece, {Point{} - rotate(ahead_from_body, far - Point{}), ahead_from_body});
  return {moments.area, along(far) - along(near), moments.xx};
}

/// What the cut's cusps weigh at the edge that the hull presses down [kg].
double pressed_mass(const Setup& setup, const Population& population, const PendingFracture& bend,
                    const geometry::CutResult& cut) {
  const fracture::Ice& ice = ice_of_floe(setup, population, bend.floe);
  const Vector ahead = rotate_back(population.bodies.rotation[population.body_of(bend.floe)], bend.normal);
  double mass = 0;
  for (const geometry::Piece& piece : cut.pieces) {
    if (piece.part != geometry::Part::kInside) continue;
    mass += fracture::edge_mass(ice, setup.scene.water.water, turning(piece.shape.polygon, ahead));
  }
  return mass;
}

}  // namespace

void turn_cusp(const Setup& setup, const PendingFracture& bend, const geometry::CutResult& cut, Population& population,
               ShipLoads& loads, AuditSums& audit) {
  const EdgePush& edge = bend.push;
  const BodyIndex ship = bend.ship;
  if (edge.speed <= 0) return;
  dynamics::Bodies& bodies = population.bodies;
  const Vector arm = bend.point_in_water - bodies.position[ship];
  const double mass = pressed_mass(setup, population, bend, cut);
  // The hull slows down by what it gives: the two move on together.
  const auto slowed = [&](Vector impulse) {
    return edge.speed_per_approach *
           dot(bend.normal,
               bodies.inverse_mass[ship] * impulse + cross(bodies.inverse_moment[ship] * cross(arm, impulse), arm));
  };
  const double given = mass * edge.speed / (1 + mass * std::max(0.0, slowed(edge.horizontal)));  // down on the edge
  const Vector impulse = -given * edge.horizontal;
  const double turned = cross(arm, impulse);
  const Vector in_ship = rotate_back(bodies.rotation[ship], impulse);
  loads.submerged.impulse += {in_ship.x, in_ship.y, turned};
  if (bodies.inverse_mass[ship] == 0) return;
  audit.energy.submersion -= push(bodies, ship, impulse, turned);
  audit.momentum.water += impulse;
  audit.impulses += length(impulse);
}

}  // namespace polynya::simulation
