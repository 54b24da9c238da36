#include <algorithm>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// What the ice under a hull takes from its ship in a step.
struct Pull {
  double speed = 0;   ///< of the ship ahead, through the water [m/s]
  double work = 0;    ///< over the way of the step [J]
  double moment = 0;  ///< that work times the pieces' distances to port [J m]
  double area = 0;    ///< under the hull [m²]
};

Vector heading_of(const dynamics::Bodies& bodies, BodyIndex ship) {
  return {bodies.rotation[ship].cosine, bodies.rotation[ship].sine};
}

/// How far the piece is to port of the ship's centre line; no farther than its hull [m].
double distance_to_port(const Setup& setup, const dynamics::Bodies& bodies, const SubmergedPiece& piece,
                        BodyIndex body) {
  const double half_beam = 0.5 * setup.underwater[piece.ship].form.beam;
  const Vector from_ship = bodies.position[body] - bodies.position[piece.ship];
  return std::clamp(rotate_back(bodies.rotation[piece.ship], from_ship).y, -half_beam, half_beam);
}

void add_piece(const Setup& setup, const dynamics::SubmersionPath& path, const Population& population,
               const SubmergedPiece& piece, Pull& pull) {
  if (piece.path >= std::max(path.bow, path.sliding)) return;  // behind it
  if (piece.path < path.sliding) pull.area += piece.area;
  if (pull.speed <= 0) return;
  const double to = piece.path + pull.speed * setup.step;
  const double work =
      piece.weight * (path.risen_over(piece.path, to) + setup.scene.ice.friction * path.slid_over(piece.path, to));
  if (work == 0) return;
  pull.work += work;
  pull.moment += work * distance_to_port(setup, population.bodies, piece, population.body_of(piece.floe));
}

/// Adds submerged pieces in their order, those that follow one another under one ship to a sum of their own:
/// it stays in registers.
void add_tiles(const Setup& setup, const Population& population, std::vector<Pull>& pulls) {
  auto piece = population.submerged.begin();
  while (piece != population.submerged.end()) {
    const int ship = piece->ship;
    const dynamics::SubmersionPath path = setup.underwater[ship].path;
    Pull pull = pulls[ship];
    for (; piece != population.submerged.end() && piece->ship == ship; ++piece)
      add_piece(setup, path, population, *piece, pull);
    pulls[ship] = pull;
  }
}

/// Brakes the ship, which it never reverses, and turns it. Enters both.
void apply(const Setup& setup, BodyIndex ship, const Pull& pull, dynamics::Bodies& bodies, SubmergedLoads& loads,
           AuditSums& audit) {
  loads.area = pull.area;
  if (pull.work == 0) return;
  const bool has_factor = setup.scene.ships[ship].hull.has_speed_factor;
  const double factor =
      has_factor ? dynamics::submersion_speed_factor(pull.speed, setup.underwater[ship].form.length) : 1;
  double impulse = factor * pull.work / (pull.speed * setup.step) * setup.step;
  const bool is_free = bodies.inverse_mass[ship] != 0;
  if (is_free) impulse = std::min(impulse, bodies.mass[ship] * pull.speed);
  const double angular = impulse * pull.moment / pull.work;
  loads.impulse += {-impulse, 0, angular};
  if (!is_free) return;
  const Vector pushed = -impulse * heading_of(bodies, ship);
  audit.energy.submerged_ice -= push(bodies, ship, pushed, angular);
  audit.momentum.water += pushed;
  audit.impulses += impulse;
}

double speed_ahead(const Setup& setup, const dynamics::Bodies& bodies, BodyIndex ship) {
  const Vector through_water = bodies.velocity[ship] - setup.current.velocity_at(bodies.position[ship]);
  return dot(heading_of(bodies, ship), through_water);
}

}  // namespace

void pull_of_submerged_ice(const Setup& setup, Population& population, std::vector<HullLoads>& loads,
                           AuditSums& audit) {
  if (population.submerged.empty()) return;
  dynamics::Bodies& bodies = population.bodies;
  const double dt = setup.step;
  std::vector<Pull> pulls(setup.scene.ships.size());
  const auto ships = static_cast<BodyIndex>(pulls.size());
  for (BodyIndex ship = 0; ship < ships; ++ship) pulls[ship].speed = speed_ahead(setup, bodies, ship);
  add_tiles(setup, population, pulls);
  for (BodyIndex ship = 0; ship < ships; ++ship) {
    apply(setup, ship, pulls[ship], bodies, loads[ship].submerged, audit);
    pulls[ship].speed = speed_ahead(setup, bodies, ship);
  }
  const bool is_still = setup.current.is_still();
  for (SubmergedPiece& piece : population.submerged) {
    piece.path += dt * pulls[piece.ship].speed;
    if (is_still) continue;
    const BodyIndex body = population.body_of(piece.floe);
    move_body(bodies, body, dt * setup.current.velocity_at(bodies.position[body]),
              dt * setup.current.angular_velocity());
  }
}

}  // namespace polynya::simulation
