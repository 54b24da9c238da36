#include "simulation/ship/sailing.hpp"

#include <cmath>

#include "elementary/elementary.hpp"
#include "simulation/ship/mooring.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Planar;
using dynamics::PlanarMatrix;
using geometry::Vector;

/// Returns a velocity in a ship's axes, with the angular velocity as yaw rate.
Planar in_ship(geometry::Rotation rotation, Vector velocity, double angular_velocity) {
  const Vector v = rotate_back(rotation, velocity);
  return {v.x, v.y, angular_velocity};
}

/// A ship in a step, in the ship's axes at the start of the step, which do not turn while impulses act.
struct ShipInStep {
  double mass = 0;    ///< mass of the ship [kg]
  double moment = 0;  ///< moment of inertia of the ship [kg m²]
  Planar now;         ///< velocity ν after the step's other impulses, in the water frame [m/s, rad/s]
  Planar start;       ///< velocity at the start of the step, before these impulses [m/s, rad/s]
  /// Velocity at the start, in the ship's axes of the previous step. The momentum of the added mass at the end of that
  /// step was computed in those axes [m/s, rad/s].
  Planar before_turn;
  Planar of_current;  ///< velocity of the current around the ship [m/s, rad/s]
  Planar of_ground;   ///< velocity of the ground in the water frame [m/s, rad/s]
};

/// Returns the angle by which a ship turned in the previous step [rad]. It is computed from the yaw rate at its end and
/// the length of the present step, which is equal unless the number of parts of a tick has changed. A moored ship turns
/// by the mean of two yaw rates (sail_ship), so its angle is stored.
double last_turn(const Setup& setup, const Step& step, const Population& population, const ShipMotion& start,
                 BodyIndex i) {
  return setup.scene.ships[i].mooring ? population.helms[i].last_turn : start.angular_velocity * step.length;
}

/// Returns the velocities of ship i in the step. `start` is its motion at the start of the step.
ShipInStep ship_of(const Setup& setup, const Step& step, const Population& population, const ShipMotion& start,
                   BodyIndex i) {
  const dynamics::Bodies& bodies = population.bodies;
  const geometry::Rotation rotation = bodies.rotation[i];
  ShipInStep ship;
  ship.mass = bodies.mass[i];
  ship.moment = bodies.moment[i];
  ship.now = in_ship(rotation, bodies.velocity[i], bodies.angular_velocity[i]);
  ship.start = in_ship(rotation, start.velocity, start.angular_velocity);
  const geometry::Rotation turn = geometry::Rotation::by(last_turn(setup, step, population, start, i));
  const Vector turned = rotate(turn, {ship.start.surge, ship.start.sway});
  ship.before_turn = {turned.x, turned.y, ship.start.yaw};
  ship.of_current = in_ship(rotation, setup.current.velocity_at(bodies.position[i]), 0);
  ship.of_ground = in_ship(rotation, -step.water_velocity, 0);
  return ship;
}

/// Returns the offset of a moored ship at the start of the step.
Offset offset_at_start(const MooringSettings& mooring, const Step& step, const dynamics::Bodies& bodies, BodyIndex i) {
  return offset_from(mooring, bodies.position[i] + step.begin.drift, bodies.angle[i]);
}

/// Forces on a ship in a step, in its axes.
struct Forces {
  Planar engine;
  Planar rudder;
  LinearForce water;
  MooringForce mooring;
};

/// Returns the forces on ship i. Engine and rudder act with their forces at the start of the step; the forces of water
/// and mooring are linear in the velocity at its end.
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
    const double speed = elementary::cos(turned) * at_stern.x - elementary::sin(turned) * at_stern.y;
    thrust = dynamics::propeller_thrust(*sailing.engine, helm.lever, speed);
  }
  forces.engine = dynamics::turned_thrust(thrust, turned, sailing.stern);
  if (sailing.rudder)
    forces.rudder =
        dynamics::rudder_force(*sailing.rudder, helm.steering_angle, through_water, thrust, sailing.hull.density);
  forces.water = {{}, dynamics::water_damping(sailing.hull, through_water), ship.of_current};
  if (is_moored(setup, population, i)) {
    const MooringSettings& mooring = *setup.scene.ships[i].mooring;
    forces.mooring =
        mooring_force(mooring, offset_at_start(mooring, step, population.bodies, i),
                      {population.bodies.rotation[i], ship.mass, ship.moment, ship.now, ship.of_ground}, step.length);
  }
  return forces;
}

/// Returns the velocity at the end of the step: (M + A + Δt D) ν⁺ = M ν + A ν_b + Δt F, with the velocity ν after the
/// step's other impulses, and ν_b in the ship's axes of the previous step (docs/theory/ship.md).
Planar solved_motion(const ShipInStep& ship, const PlanarMatrix& added_mass, const Forces& forces, double dt) {
  const PlanarMatrix inertia = PlanarMatrix{{{{ship.mass, 0, 0}, {0, ship.mass, 0}, {0, 0, ship.moment}}}};
  const MooringForce& mooring = forces.mooring;
  const PlanarMatrix damping = forces.water.damping + mooring.spring.damping + mooring.damper.damping;
  const Planar force =
      forces.engine + forces.rudder + forces.water.at({}) + mooring.spring.at({}) + mooring.damper.at({});
  return solve(inertia + added_mass + dt * damping, inertia * ship.now + added_mass * ship.before_turn + dt * force);
}

/// The impulses of a mooring in a step [N s, N m s].
struct MooringImpulses {
  Planar spring;
  Planar damper;
};

/// Adds an impulse in the ship's axes to a flow of momentum in the accounts, and returns its work at the mean of the
/// velocities before and after [J].
double enter(Planar impulse, Planar mean, geometry::Rotation rotation, Vector& momentum, AuditSums& audit) {
  const Vector in_water = rotate(rotation, {impulse.surge, impulse.sway});
  momentum += in_water;
  audit.impulses += length(in_water);
  return dot(impulse, mean);
}

/// Adds the work of a mooring to the accounts. The ship's motion over ground does work on spring and damper; the motion
/// of the ground in the water frame does work on the ship.
void enter_mooring(const MooringImpulses& impulses, Planar mean, const ShipInStep& ship, MooringFlows& flows) {
  const Planar over_ground = mean - ship.of_ground;
  const double given = dot(impulses.spring, over_ground);
  (given > 0 ? flows.given_back : flows.taken_up) += std::abs(given);
  flows.damping -= dot(impulses.damper, over_ground);
  flows.ground += dot(impulses.spring + impulses.damper, ship.of_ground);
}

/// Adds the impulses on a ship and their work to the accounts. `mean` is the mean of the velocities before and after.
void enter_all(const SailingLoads& impulses, Planar mean, geometry::Rotation rotation, AuditSums& audit) {
  MomentumFlows& momentum = audit.momentum;
  audit.energy.thrust += enter(impulses.engine, mean, rotation, momentum.thrust, audit);
  enter(impulses.mooring, mean, rotation, momentum.held, audit);  // its work is added by enter_mooring()
  audit.energy.drag -= enter(impulses.water, mean, rotation, momentum.water, audit) +
                       enter(impulses.rudder, mean, rotation, momentum.water, audit);
}

/// Adds the impulses of a step to the sums of a recording interval.
void add(const SailingLoads& of_step, SailingLoads& sum) {
  sum.water += of_step.water;
  sum.engine += of_step.engine;
  sum.rudder += of_step.rudder;
  sum.mooring += of_step.mooring;
}

/// Returns the offset of a moored ship at the end of a step in which it moves by the mean of its velocities.
Offset offset_at_end(const MooringSettings& mooring, const Step& step, const dynamics::Bodies& bodies, Planar mean,
                     BodyIndex i) {
  const Vector velocity = rotate(bodies.rotation[i], {mean.surge, mean.sway}) + step.water_velocity;
  return offset_from(mooring, bodies.position[i] + step.begin.drift + step.length * velocity,
                     bodies.angle[i] + step.length * mean.yaw);
}

/// Returns the horizontal force of a mooring [N]: of its spring at an offset, and of its damper as a mean over the
/// step. `damped` is the force of the damper in the ship's axes.
double horizontal_force(const MooringSettings& mooring, const Offset& offset, Planar damped,
                        geometry::Rotation rotation) {
  const Vector in_world = rotate(rotation, {damped.surge, damped.sway});
  const Vector in_mooring = rotate_back(geometry::Rotation::by(mooring.heading), in_world);
  return elementary::hypot(in_mooring.x - mooring.surge_stiffness * offset.shift.x,
                           in_mooring.y - mooring.sway_stiffness * offset.shift.y);
}

/// Breaks a mooring at the end of the step if its force exceeds its break load; one with the break load 0 never breaks.
/// The energy that it stores is added to `lost`, and the event to `breaks`.
void break_mooring(const MooringSettings& mooring, const Step& step, const Offset& offset, double force, BodyIndex i,
                   Population& population, double& lost, std::vector<Event>& breaks) {
  if (mooring.break_load <= 0 || force <= mooring.break_load) return;
  Helm& helm = population.helms[i];
  helm.is_adrift = true;
  helm.adrift_since = step.end.time;
  lost += stored_energy(mooring, offset);
  const geometry::Point place =
      mooring.position_in_world + rotate(geometry::Rotation::by(mooring.heading), offset.shift);
  breaks.push_back({helm.adrift_since, i, place, MooringBreak{offset.shift, force, mooring.break_load}});
}

/// Corrects the displacement of a moored ship in the step to the one of its mean velocity: x⁺ = x + ½Δt (v + v⁺).
/// integrate(), which runs later, adds Δt v⁺, so this function adds ½Δt (v − v⁺). With this displacement, the mooring
/// stores exactly the energy that its work takes from the ship.
void move_by_mean(double dt, const ShipMotion& before, BodyIndex i, dynamics::Bodies& bodies) {
  move_body(bodies, i, 0.5 * dt * (before.velocity - bodies.velocity[i]),
            0.5 * dt * (before.angular_velocity - bodies.angular_velocity[i]));
}

/// Adds the work of a mooring to the accounts, and breaks it if its force is too large.
void follow_mooring(const MooringSettings& mooring, const Step& step, const ShipInStep& ship, Planar mean,
                    const MooringImpulses& impulses, BodyIndex i, Population& population, MooringFlows& flows,
                    std::vector<Event>& breaks) {
  const Offset offset = offset_at_end(mooring, step, population.bodies, mean, i);
  const double force =
      horizontal_force(mooring, offset, (1 / step.length) * impulses.damper, population.bodies.rotation[i]);
  enter_mooring(impulses, mean, ship, flows);
  break_mooring(mooring, step, offset, force, i, population, flows.breaking, breaks);
}

/// Moves ship i by the forces of water, engine, steering and mooring in the step, and adds their impulses and work to
/// its loads and to the accounts. For a ship of prescribed motion only the loads are computed.
void sail_ship(const Setup& setup, const Step& step, const ShipMotion& start, BodyIndex i, Population& population,
               Accounts& accounts, std::vector<Event>& mooring_breaks) {
  dynamics::Bodies& bodies = population.bodies;
  const double dt = step.length;
  const bool is_free = bodies.inverse_mass[i] != 0;
  const bool was_moored = is_moored(setup, population, i);
  const ShipInStep ship = ship_of(setup, step, population, start, i);
  const PlanarMatrix& added_mass = setup.sailing[i].hull.added_mass;
  const Forces forces = forces_on(setup, step, population, ship, i);
  const Planar end = is_free ? solved_motion(ship, added_mass, forces, dt) : ship.now;
  const Planar mean = 0.5 * (ship.now + end);
  const MooringImpulses held{dt * forces.mooring.spring.at(end), dt * forces.mooring.damper.at(end)};
  SailingLoads impulses;
  impulses.engine = dt * forces.engine;
  impulses.rudder = dt * forces.rudder;
  impulses.mooring = held.spring + held.damper;
  impulses.water = dt * forces.water.at(end);
  if (is_free) impulses.water += added_mass * (ship.before_turn - end);
  add(impulses, accounts.sailing[i]);
  population.helms[i].last_turn = dt * (was_moored ? mean : end).yaw;
  if (was_moored)
    follow_mooring(*setup.scene.ships[i].mooring, step, ship, mean, held, i, population, accounts.audit.moorings,
                   mooring_breaks);
  if (!is_free) return;
  enter_all(impulses, mean, bodies.rotation[i], accounts.audit);
  const ShipMotion before{bodies.velocity[i], bodies.angular_velocity[i]};
  bodies.velocity[i] = rotate(bodies.rotation[i], {end.surge, end.sway});
  bodies.angular_velocity[i] = end.yaw;
  if (was_moored) move_by_mean(dt, before, i, bodies);
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

/// Returns the hull of a ship in the water. `engine` is null for a ship without an engine. With an engine, the
/// resistance follows from its bollard pull and open-water speed; without one, from the scene's resistance coefficient
/// if water acts on the hull.
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

/// Returns the rudders of a ship. A single rudder of a ship with two propellers stands on the centreline, between their
/// races. `position` is the x of the rudders in the ship's frame [m].
dynamics::Rudder rudder_of(const RudderSettings& settings, const Engine* engine, double position) {
  const int propellers = engine ? engine->propellers : 1;
  dynamics::Rudder rudder{.area = settings.area, .aspect_ratio = settings.aspect_ratio, .position = position};
  rudder.count = settings.count > 0 ? settings.count : propellers;
  const bool has_race = engine && !(rudder.count == 1 && propellers == 2);
  if (!has_race) return rudder;
  rudder.propeller_area = engine->propeller_area / propellers;
  rudder.thrust_share = 1.0 / propellers;
  rudder.has_nozzle = engine->has_nozzles;
  return rudder;
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
    sailing.rudder = rudder_of(*rudder, engine, sailing.stern);
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

void store_motion(const Population& population, StepData& data) {
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
