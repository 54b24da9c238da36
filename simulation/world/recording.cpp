#include <algorithm>
#include <cmath>

#include "simulation/world/step.hpp"

namespace polynya::simulation {
namespace {

using dynamics::Planar;
using geometry::Vector;

/// Returns the value with the larger magnitude.
double larger(double a, double b) {
  return std::abs(b) > std::abs(a) ? b : a;
}
/// Returns, for each component, the value with the larger magnitude.
Planar larger(Planar a, Planar b) {
  return {larger(a.surge, b.surge), larger(a.sway, b.sway), larger(a.yaw, b.yaw)};
}
/// Returns the mean force of an impulse over a time [s].
Planar over(Planar impulse, double time) {
  return {impulse.surge / time, impulse.sway / time, impulse.yaw / time};
}

/// Adds the impulses of a contact to the loads of one of its two bodies, which is a hull. `sign` is +1 if the hull is
/// the contact's body b, on which its impulses act, and −1 if it is body a. The fraction Contact::step_share of the
/// impulses belongs to the step; the rest makes up for the time before the contact was found.
void add_contact(const Population& population, const dynamics::Contact& c, BodyIndex ship, double sign,
                 HullLoads& hull_loads) {
  const bool is_with_ship = population.is_hull(ship == c.a ? c.b : c.a);
  ContactLoads& loads = is_with_ship ? hull_loads.hulls : hull_loads.ice;
  const auto add = [&](geometry::Point at, Vector impulse, bool is_slip) {
    const Planar on_ship = planar_of(population.bodies, ship, at, impulse);
    loads.impulse += on_ship;
    loads.step_impulse += c.step_share * on_ship;
    if (is_slip) loads.friction += on_ship;
  };
  for (int end = 0; end < 2; ++end) add(c.ends[end], sign * c.normal_impulse[end] * c.normal, false);
  add(c.middle(), sign * c.slip_impulse * perpendicular(c.normal), true);
  ++loads.contacts;
}

/// Adds the loads of a step of length dt [s] to the sums of a recording interval. The missed part of the impulse is
/// booked in this and later steps, so that it does not increase the largest force of a single step (CarriedLoad).
void add_step(ContactLoads& sum, const ContactLoads& step, double dt) {
  const Planar of_step = step.step_impulse;
  const Planar missed = step.impulse - of_step;
  const Planar booked{sum.carried[0].book(of_step.surge, missed.surge, dt),
                      sum.carried[1].book(of_step.sway, missed.sway, dt),
                      sum.carried[2].book(of_step.yaw, missed.yaw, dt)};
  sum.impulse += booked;
  sum.friction += step.friction;
  sum.largest = larger(sum.largest, over(booked, dt));
  sum.contacts = step.contacts;
}

/// Adds the loads of a step of length dt [s] to the sums of a recording interval.
void add_step(HullLoads& sum, const HullLoads& step, double dt) {
  add_step(sum.ice, step.ice, dt);
  add_step(sum.hulls, step.hulls, dt);
  sum.submerged.impulse += step.submerged.impulse;
  sum.submerged.area = step.submerged.area;
  sum.collision = larger(sum.collision, step.collision);
}

/// Enters the helm's state, and the mean loads of water, engine, rudder, and mooring over the interval [s].
void add_sailing(const Setup& setup, const Helm& helm, const SailingLoads& loads, double interval, HullSample& sample) {
  HullSample& s = sample;
  const auto mean = [&](Planar impulse) { return (1 / interval) * impulse; };
  s.from_water = mean(loads.water);
  s.from_engine = mean(loads.engine);
  s.from_rudder = mean(loads.rudder);
  s.from_mooring = mean(loads.mooring);
  s.lever = helm.lever;
  s.steering_angle = helm.steering_angle;
  s.rams = helm.memory.rams;
  s.distance_gained = helm.memory.distance_gained;
  const auto& engine = setup.sailing[s.ship].engine;
  s.delivered_power = engine ? std::abs(helm.lever) * engine->power : 0;
}

/// Returns the force along the heading that holds a hull at its speed [N]: the negative sum of the forces of ice, other
/// hulls, ice under the hull and water.
double holding_force(const HullSample& s) {
  return -(s.from_ice.surge + s.from_ships.surge + s.from_submerged.surge + s.from_water.surge);
}

// Return HullSample::thrust [N].
double thrust_of(const Ship& ship, const HullSample& s) {
  if (const auto* constant = std::get_if<ConstantThrust>(&ship.propulsion)) return constant->thrust;
  return std::holds_alternative<Engine>(ship.propulsion) ? s.from_engine.surge : holding_force(s);
}
double thrust_of(const Structure&, const HullSample& s) {
  return holding_force(s);
}
double thrust_of(const Wall& wall, const HullSample& s) {
  return wall.pressure ? wall.load() : holding_force(s);
}

/// Returns the time since the last sample [s].
double interval_of(const Clock& clock, const Accounts& accounts) {
  return static_cast<double>(clock.ticks - accounts.sampled_at) * clock.tick;
}

/// Returns the sample of a hull for the interval that ends now.
HullSample sample_of(const Setup& setup, const Clock& clock, const Population& population, BodyIndex ship,
                     const Accounts& accounts) {
  const HullLoads& loads = accounts.loads[ship];
  const dynamics::Bodies& bodies = population.bodies;
  const double interval = interval_of(clock, accounts);
  HullSample sample;
  sample.time = clock.time();
  sample.ship = ship;
  sample.from_ice = over(loads.ice.impulse, interval);
  sample.friction_of_ice = over(loads.ice.friction, interval);
  sample.carried = {loads.ice.carried[0].impulse, loads.ice.carried[1].impulse, loads.ice.carried[2].impulse};
  sample.from_ice_largest = loads.ice.largest;
  sample.collision = loads.collision;
  sample.from_ships = over(loads.hulls.impulse, interval);
  sample.from_ships_largest = loads.hulls.largest;
  sample.from_submerged = over(loads.submerged.impulse, interval);
  sample.position_in_world = bodies.position[ship] + drift_at(setup, clock.time());
  sample.heading = bodies.angle[ship];
  sample.velocity_in_world = bodies.velocity[ship] + population.water_velocity;
  sample.yaw_rate = bodies.angular_velocity[ship];
  sample.submerged_area = loads.submerged.area;
  if (population.kind(ship) == BodyKind::kShip)
    add_sailing(setup, population.helms[ship], accounts.sailing[ship], interval, sample);
  sample.thrust = visit_hull(setup.scene, static_cast<std::size_t>(ship),
                             [&](const auto& hull) { return thrust_of(hull, sample); });
  sample.contacts = loads.ice.contacts;
  sample.contacts_with_ships = loads.hulls.contacts;
  return sample;
}

}  // namespace

void tally_loads(const Population& population, const std::vector<dynamics::Contact>& contacts,
                 std::vector<HullLoads>& loads) {
  for (const dynamics::Contact& c : contacts) {
    if (population.is_hull(c.a)) add_contact(population, c, c.a, -1, loads[c.a]);
    if (population.is_hull(c.b)) add_contact(population, c, c.b, +1, loads[c.b]);
  }
}

void sum_loads(const Step& step, const StepData& data, Accounts& accounts) {
  for (std::size_t hull = 0; hull < data.loads.size(); ++hull)
    add_step(accounts.loads[hull], data.loads[hull], step.length);
}

void sample_loads(const Setup& setup, const Clock& clock, const Population& population, Books books) {
  Accounts& accounts = books.accounts;
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull)
    books.journal.samples.push_back(sample_of(setup, clock, population, hull, accounts));
  sample_panels(setup, clock, interval_of(clock, accounts), accounts.panels, books.journal);
  for (HullLoads& loads : accounts.loads) {
    HullLoads next;
    std::ranges::copy(loads.ice.carried, next.ice.carried);
    std::ranges::copy(loads.hulls.carried, next.hulls.carried);
    loads = next;
  }
  std::ranges::fill(accounts.sailing, SailingLoads{});
  accounts.sampled_at = clock.ticks;
}

}  // namespace polynya::simulation
