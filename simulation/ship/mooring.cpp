#include "simulation/ship/mooring.hpp"

#include <array>

namespace polynya::simulation {

using dynamics::Planar;
using dynamics::PlanarMatrix;
using geometry::Rotation;
using geometry::Vector;

namespace {

/// Coefficients of a diagonal matrix in the axes of a mooring: along, across, about the vertical.
using Diagonal = std::array<double, 3>;

/// Returns the matrix in the axes of a ship. `to_ship` is the ship's rotation in the moored axes.
PlanarMatrix in_ship_axes(const Diagonal& d, Rotation to_ship) {
  const auto [c, s] = to_ship;
  const double shared = (d[1] - d[0]) * s * c;
  return {{{{d[0] * c * c + d[1] * s * s, shared, 0}, {shared, d[0] * s * s + d[1] * c * c, 0}, {0, 0, d[2]}}}};
}

/// Returns the weight θ of a damper: the smallest value of at least ½ with which the damper alone does not reverse a
/// velocity within a step of length dt [s].
double weight_at_end(double damping, double inertia, double dt) {
  return dt * damping > 2 * inertia ? 1 - inertia / (dt * damping) : 0.5;
}

/// Returns the sum of the energies that moorings store at the offsets offset_of(mooring, ship) [J].
template <class OffsetOf>
double sum_of_stored(const Setup& setup, const Population& population, OffsetOf offset_of) {
  double sum = 0;
  for (BodyIndex ship = 0; ship < std::ssize(setup.scene.ships); ++ship) {
    if (!is_moored(setup, population, ship)) continue;
    const MooringSettings& mooring = *setup.scene.ships[ship].mooring;
    sum += stored_energy(mooring, offset_of(mooring, ship));
  }
  return sum;
}

}  // namespace

Offset offset_from(const MooringSettings& mooring, geometry::Point place, double angle) {
  return {rotate_back(Rotation::by(mooring.heading), place - mooring.position_in_world), angle - mooring.heading};
}

MooringForce mooring_force(const MooringSettings& mooring, const Offset& offset, const MooredShip& ship, double dt) {
  const Rotation to_ship = geometry::relative_pose({{}, Rotation::by(mooring.heading)}, {{}, ship.rotation}).rotation;
  const Diagonal stiffness{mooring.surge_stiffness, mooring.sway_stiffness, mooring.yaw_stiffness};
  const Diagonal damping{mooring.surge_damping, mooring.sway_damping, mooring.yaw_damping};
  const Diagonal inertia{ship.mass, ship.mass, ship.moment};
  Diagonal stiff{}, at_start{}, at_end{};
  for (std::size_t i = 0; i < 3; ++i) {
    const double weight = weight_at_end(damping[i], inertia[i], dt);
    stiff[i] = 0.25 * dt * stiffness[i];
    at_start[i] = (1 - weight) * damping[i];
    at_end[i] = weight * damping[i];
  }
  const Vector pull = rotate_back(to_ship, {-stiffness[0] * offset.shift.x, -stiffness[1] * offset.shift.y});
  const Planar over_ground = ship.now - ship.of_ground;
  MooringForce force;
  force.spring.damping = in_ship_axes(stiff, to_ship);
  force.spring.constant = Planar{pull.x, pull.y, -stiffness[2] * offset.turn} - force.spring.damping * over_ground;
  force.spring.against = ship.of_ground;
  force.damper.damping = in_ship_axes(at_end, to_ship);
  force.damper.constant = -1 * (in_ship_axes(at_start, to_ship) * over_ground);
  force.damper.against = ship.of_ground;
  return force;
}

double stored_energy(const MooringSettings& mooring, const Offset& offset) {
  const auto [x, y] = offset.shift;
  return 0.5 * (mooring.surge_stiffness * x * x + mooring.sway_stiffness * y * y +
                mooring.yaw_stiffness * offset.turn * offset.turn);
}

bool is_moored(const Setup& setup, const Population& population, BodyIndex ship) {
  return setup.scene.ships[ship].mooring.has_value() && !population.helms[ship].is_adrift;
}

double stored_in_moorings(const Setup& setup, const Population& population, Vector drift) {
  const dynamics::Bodies& bodies = population.bodies;
  return sum_of_stored(setup, population, [&](const MooringSettings& mooring, BodyIndex ship) {
    return offset_from(mooring, bodies.position[ship] + drift, bodies.angle[ship]);
  });
}

double stored_after(const Setup& setup, const Step& step, const Population& population) {
  const dynamics::Bodies& bodies = population.bodies;
  return sum_of_stored(setup, population, [&](const MooringSettings& mooring, BodyIndex ship) {
    return offset_from(mooring, bodies.position[ship] + step.length * bodies.velocity[ship] + step.end.drift,
                       bodies.angle[ship] + step.length * bodies.angular_velocity[ship]);
  });
}

}  // namespace polynya::simulation
