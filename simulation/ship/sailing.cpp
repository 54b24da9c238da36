#include "simulation/ship/sailing.hpp"

#include <cmath>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Planar;
using dynamics::PlanarMatrix;
using geometry::Vector;

Planar in_ship(geometry::Rotation rotation, Vector velocity, double angular_velocity) {
  const Vector v = rotate_back(rotation, velocity);
  return {v.x, v.y, angular_velocity};
}

/// A ship in a step, in the ship's axes, which stand still while impulses act.
struct ShipInStep {
  double mass = 0;     ///< [kg]
  double moment = 0;   ///< [kg m²]
  Planar now;          ///< ν with the step's other impulses, in the water frame
  Planar start;        ///< ν before them
  Planar before_turn;  ///< ν in the ship's axes of the step before: it is there that the water had it
  Planar of_current;   ///< of the water around it
  Planar of_ground;    ///< of the ground
};

ShipInStep ship_of(const Setup& setup, const Step& step, const dynamics::Bodies& bodies, const ShipMotion& start,
                   BodyIndex i) {
  const geometry::Rotation rotation = bodies.rotation[i];
  ShipInStep ship;
  ship.mass = bodies.mass[i];
  ship.moment = bodies.moment[i];
  ship.now = in_ship(rotation, bodies.velocity[i], bodies.angular_velocity[i]);
  ship.start = in_ship(rotation, start.velocity, start.angular_velocity);
  const geometry::Rotation turn = geometry::Rotation::by(start.angular_velocity * step.length);
  const Vector turned = rotate(turn, {ship.start.surge, ship.start.sway});
  ship.before_turn = {turned.x, turned.y, ship.start.yaw};
  ship.of_current = in_ship(rotation, setup.current.velocity_at(bodies.position[i]), 0);
  ship.of_ground = in_ship(rotation, -step.water_velocity, 0);
  return ship;
}

/// A linear force k − D (ν − of what it moves against).
struct LinearForce {
  Planar constant;
  PlanarMatrix damping;
  Planar against;
  Planar at(Planar velocity) const { return constant - damping * (velocity - against); }
};

/// The pull of a mooring at the end of the step, in the axes of the ship.
LinearForce mooring_force(const MooringSettings& mooring, const Step& step, const dynamics::Bodies& bodies,
                          const ShipInStep& ship, BodyIndex i) {
  const auto to_mooring = geometry::Rotation::by(mooring.heading);
  const double turn = bodies.angle[i] - mooring.heading;
  const Vector off = rotate_back(to_mooring, bodies.position[i] + step.begin.drift - mooring.position_in_world);
  const geometry::Rotation to_ship = geometry::relative_pose({{}, to_mooring}, {{}, bodies.rotation[i]}).rotation;
  const Vector pull = rotate_back(to_ship, {-mooring.surge_stiffness * off.x, -mooring.sway_stiffness * off.y});
  const double dt = step.length;
  const double along = dt * mooring.surge_stiffness + mooring.surge_damping;
  const double across = dt * mooring.sway_stiffness + mooring.sway_damping;
  const auto [c, s] = to_ship;
  const double shared = (across - along) * s * c;
  LinearForce force;
  force.constant = {pull.x, pull.y, -mooring.yaw_stiffness * turn};
  force.damping.rows = {{{along * c * c + across * s * s, shared, 0},
                         {shared, along * s * s + across * c * c, 0},
                         {0, 0, dt * mooring.yaw_stiffness + mooring.yaw_damping}}};
  force.against = ship.of_ground;
  return force;
}

/// The forces on a ship in a step.
struct Forces {
  Planar engine;
  Planar rudder;
  LinearForce water;
  LinearForce mooring;
};

Forces forces_on(const Setup& setup, const Step& step, const Population& population, const ShipInStep& ship,
                 BodyIndex i) {
  const Sailing& sailing = setup.sailing[i];
  const Helm& helm = population.helms[i];
  const Planar through_water = ship.start - ship.of_current;
  Forces forces;
  const double turned = sailing.has_azimuth ? helm.steering_angle : 0;
  double thrust = 0;
  if (sailing.engine) {
    const Vector at_stern{through_water.surge, through_water.sway + sailing.stern * through_water.yaw};
    const double speed = std::cos(turned) * at_stern.x - std::sin(turned) * at_stern.y;
    thrust = dynamics::propeller_thrust(*sailing.engine, helm.lever, speed);
  }
  forces.engine = dynamics::turned_thrust(thrust, turned, sailing.stern);
  if (sailing.rudder)
    forces.rudder =
        dynamics::rudder_force(*sailing.rudder, helm.steering_angle, through_water, thrust, sailing.hull.density);
  forces.water = {{}, dynamics::water_damping(sailing.hull, through_water), ship.of_current};
  const auto& mooring = setup.scene.ships[i].mooring;
  if (mooring && !helm.is_adrift) forces.mooring = mooring_force(*mooring, step, population.bodies, ship, i);
  return forces;
}

/// ν at the end of the step: (M + A + Δt D) ν⁺ = M ν + A ν_b + Δt F, ν with the step's other impulses, ν_b in
/// the ship's axes of the step before (docs/theory/ship.md).
Planar solved_motion(const ShipInStep& ship, const PlanarMatrix& added_mass, const Forces& forces, double dt) {
  const PlanarMatrix inertia = PlanarMatrix{{{{ship.mass, 0, 0}, {0, ship.mass, 0}, {0, 0, ship.moment}}}};
  const PlanarMatrix damping = forces.water.damping + forces.mooring.damping;
  const Planar force = forces.engine + forces.rudder + forces.water.at({}) + forces.mooring.at({});
  return solve(inertia + added_mass + dt * damping, inertia * ship.now + added_mass * ship.before_turn + dt * force);
}

/// Enters an impulse that took a ship from one velocity to another, its part of the work at their mean.
void enter(Planar impulse, Planar mean, geometry::Rotation rotation, double& energy, Vector& momentum,
           AuditSums& audit) {
  const Vector in_water = rotate(rotation, {impulse.surge, impulse.sway});
  energy += dot(impulse, mean);
  momentum += in_water;
  audit.impulses += length(in_water);
}

void enter_all(const SailingLoads& impulses, Planar mean, geometry::Rotation rotation, AuditSums& audit) {
  EnergyFlows& energy = audit.energy;
  MomentumFlows& momentum = audit.momentum;
  enter(impulses.engine, mean, rotation, energy.thrust, momentum.thrust, audit);
  enter(impulses.mooring, mean, rotation, energy.thrust, momentum.held, audit);
  double given = 0;
  enter(impulses.water, mean, rotation, given, momentum.water, audit);
  enter(impulses.rudder, mean, rotation, given, momentum.water, audit);
  energy.drag -= given;
}

void add(const SailingLoads& of_step, SailingLoads& sum) {
  sum.water += of_step.water;
  sum.engine += of_step.engine;
  sum.rudder += of_step.rudder;
  sum.mooring += of_step.mooring;
}

/// The mooring breaks where it held the ship with more than it can. `velocity` is the ship's in the water at
/// the end of the step: the pull is that of the place where the step takes the ship.
void break_mooring(const MooringSettings& mooring, const Step& step, Planar impulse, Vector velocity, BodyIndex i,
                   Population& population, std::vector<Event>& breaks) {
  const double force = std::hypot(impulse.surge, impulse.sway) / step.length;
  if (mooring.break_load <= 0 || force <= mooring.break_load) return;
  Helm& helm = population.helms[i];
  helm.is_adrift = true;
  helm.adrift_since = step.end.time;
  const geometry::Point place =
      population.bodies.position[i] + step.begin.drift + step.length * (velocity + step.water_velocity);
  const Vector offset = rotate_back(geometry::Rotation::by(mooring.heading), place - mooring.position_in_world);
  breaks.push_back({helm.adrift_since, i, place, MooringBreak{offset, force, mooring.break_load}});
}

void sail_ship(const Setup& setup, const Step& step, const ShipMotion& start, BodyIndex i, Population& population,
               Accounts& accounts, std::vector<Event>& mooring_breaks) {
  dynamics::Bodies& bodies = population.bodies;
  const double dt = step.length;
  const bool is_free = bodies.inverse_mass[i] != 0;
  const ShipInStep ship = ship_of(setup, step, bodies, start, i);
  const PlanarMatrix& added_mass = setup.sailing[i].hull.added_mass;
  const Forces forces = forces_on(setup, step, population, ship, i);
  const Planar end = is_free ? solved_motion(ship, added_mass, forces, dt) : ship.now;
  SailingLoads impulses;
  impulses.engine = dt * forces.engine;
  impulses.rudder = dt * forces.rudder;
  impulses.mooring = dt * forces.mooring.at(end);
  impulses.water = dt * forces.water.at(end);
  if (is_free) impulses.water += added_mass * (ship.before_turn - end);
  add(impulses, accounts.sailing[i]);
  const Vector velocity = rotate(bodies.rotation[i], {end.surge, end.sway});
  if (const auto& mooring = setup.scene.ships[i].mooring)
    break_mooring(*mooring, step, impulses.mooring, velocity, i, population, mooring_breaks);
  if (!is_free) return;
  enter_all(impulses, 0.5 * (ship.now + end), bodies.rotation[i], accounts.audit);
  bodies.velocity[i] = velocity;
  bodies.angular_velocity[i] = end.yaw;
}

}  // namespace

dynamics::MainDimensions dimensions_of(const Ship& ship, double water_density) {
  const geometry::Box box = bounding_box(ship.hull.waterline);
  dynamics::MainDimensions d;
  d.length = box.high.x - box.low.x;
  d.beam = box.high.y - box.low.y;
  d.draught = ship.hull.draught;
  d.block_coefficient = ship.water.block_coefficient > 0 ? ship.water.block_coefficient
                                                         : ship.mass / (water_density * d.length * d.beam * d.draught);
  return d;
}

namespace {

dynamics::HullInWater hull_in_water(const Ship& ship, const dynamics::Engine* engine, double density) {
  const geometry::Box box = bounding_box(ship.hull.waterline);
  const dynamics::MainDimensions dimensions = dimensions_of(ship, density);
  dynamics::HullInWater hull;
  hull.density = density;
  hull.length = dimensions.length;
  hull.draught = dimensions.draught;
  hull.aft = box.low.x;
  hull.fore = box.high.x;
  if (engine) hull.quadratic_resistance = quadratic_resistance(*engine);
  if (!ship.water.acts) return hull;
  hull.cross_flow_drag = ship.water.cross_flow_drag;
  hull.derivatives = clarke_derivatives(dimensions);
  hull.added_mass = added_mass_of(hull.derivatives, hull.length, density, ship.water.surge_added_mass * ship.mass);
  if (!engine)
    hull.quadratic_resistance = 0.5 * density * ship.water.resistance_coefficient * wetted_surface(dimensions);
  return hull;
}

}  // namespace

Sailing sailing_of(const Ship& ship, double water_density) {
  const auto* engine = std::get_if<Engine>(&ship.propulsion);
  Sailing sailing;
  sailing.is_active = sails(ship);
  if (!sailing.is_active) return sailing;
  sailing.hull = hull_in_water(ship, engine, water_density);
  sailing.stern = sailing.hull.aft;
  if (engine) sailing.engine = *engine;
  if (const auto* rudder = std::get_if<RudderSettings>(&ship.steering)) {
    sailing.rudder = dynamics::Rudder{.area = rudder->area,
                                      .aspect_ratio = rudder->aspect_ratio,
                                      .position = sailing.stern,
                                      .race_area = engine ? engine->propeller_area : 0};
    sailing.steering_rate = rudder->rate;
    sailing.steering_most = rudder->most;
  }
  if (const auto* azimuth = std::get_if<AzimuthSettings>(&ship.steering)) {
    sailing.has_azimuth = true;
    sailing.steering_rate = azimuth->rate;
    sailing.steering_most = azimuth->most;
  }
  return sailing;
}

void keep_motion(const Population& population, StepData& data) {
  data.start.resize(population.helms.size());
  for (std::size_t ship = 0; ship < data.start.size(); ++ship)
    data.start[ship] = {population.bodies.velocity[ship], population.bodies.angular_velocity[ship]};
  data.water_from_hull.clear();
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    data.water_from_hull.push_back(water_from_body(population.bodies, hull));
}

void sail(const Setup& setup, const Step& step, StepData& data, Population& population, Accounts& accounts) {
  data.mooring_breaks.clear();
  for (BodyIndex ship = 0; ship < std::ssize(setup.sailing); ++ship) {
    if (!setup.sailing[ship].is_active) continue;
    population.helms[ship].ice_force = (1 / step.length) * data.loads[ship].ice.impulse;
    sail_ship(setup, step, data.start[ship], ship, population, accounts, data.mooring_breaks);
  }
}

}  // namespace polynya::simulation
