#include <cmath>

#include "simulation/step.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

double larger(double a, double b) {
  return std::abs(b) > std::abs(a) ? b : a;
}
Vector larger(Vector a, Vector b) {
  return {larger(a.x, b.x), larger(a.y, b.y)};
}

/// Adds what a contact's impulses did to the ship.
void add_contact(World& world, const dynamics::Contact& c, BodyIndex ship, double sign) {
  const bool is_with_ship = world.is_ship(ship == c.a ? c.b : c.a);
  ContactLoads& loads = is_with_ship ? world.step_loads[ship].ships : world.step_loads[ship].ice;
  const auto add = [&](geometry::Point at, Vector impulse) {
    loads.impulse += rotate_back(world.bodies.rotation[ship], impulse);
    loads.angular_impulse += cross(at - world.bodies.position[ship], impulse);
  };
  for (int end = 0; end < 2; ++end) add(c.ends[end], sign * c.normal_impulse[end] * c.normal);
  add(c.middle(), sign * c.slip_impulse * perpendicular(c.normal));
  ++loads.contacts;
}

void add_step(ContactLoads& sum, const ContactLoads& step, double dt) {
  sum.impulse += step.impulse;
  sum.angular_impulse += step.angular_impulse;
  sum.largest = larger(sum.largest, step.impulse / dt);
  sum.largest_moment = larger(sum.largest_moment, step.angular_impulse / dt);
  sum.contacts = step.contacts;
}

void add_step(ShipLoads& sum, const ShipLoads& step, double dt) {
  add_step(sum.ice, step.ice, dt);
  add_step(sum.ships, step.ships, dt);
  sum.peak = larger(sum.peak, step.peak);
  sum.peak_moment = larger(sum.peak_moment, step.peak_moment);
}

ShipSample sample_of(const World& world, BodyIndex ship, double interval) {
  const ShipLoads& loads = world.loads[ship];
  const dynamics::Bodies& bodies = world.bodies;
  ShipSample sample;
  sample.time = world.time();
  sample.ship = ship;
  sample.surge_force = loads.ice.impulse.x / interval;
  sample.sway_force = loads.ice.impulse.y / interval;
  sample.yaw_moment = loads.ice.angular_impulse / interval;
  sample.surge_peak = loads.peak.x;
  sample.sway_peak = loads.peak.y;
  sample.yaw_peak = loads.peak_moment;
  sample.surge_max = loads.ice.largest.x;
  sample.sway_max = loads.ice.largest.y;
  sample.yaw_max = loads.ice.largest_moment;
  sample.surge_from_ships = loads.ships.impulse.x / interval;
  sample.sway_from_ships = loads.ships.impulse.y / interval;
  sample.yaw_from_ships = loads.ships.angular_impulse / interval;
  sample.surge_from_ships_max = loads.ships.largest.x;
  sample.sway_from_ships_max = loads.ships.largest.y;
  sample.yaw_from_ships_max = loads.ships.largest_moment;
  sample.position_in_world = bodies.position[ship] + world.drift();
  sample.heading = bodies.angle[ship];
  sample.velocity_in_world = bodies.velocity[ship] + world.scene.water.drift;
  sample.yaw_rate = bodies.angular_velocity[ship];
  const auto* thrust = std::get_if<ConstantThrust>(&world.scene.ships[ship].propulsion);
  const double held_back = sample.surge_force + sample.surge_from_ships;
  sample.thrust = thrust != nullptr ? thrust->thrust : -held_back;
  sample.contacts = loads.ice.contacts;
  sample.contacts_with_ships = loads.ships.contacts;
  return sample;
}

}  // namespace

void tally_loads(World& world) {
  for (const dynamics::Contact& c : world.contacts) {
    if (world.is_ship(c.a)) add_contact(world, c, c.a, -1);
    if (world.is_ship(c.b)) add_contact(world, c, c.b, +1);
  }
}

void record(World& world) {
  for (std::size_t ship = 0; ship < world.loads.size(); ++ship) {
    add_step(world.loads[ship], world.step_loads[ship], world.scene.time.step);
  }
  world.counts.peak_awake = std::max(world.counts.peak_awake, static_cast<std::int64_t>(world.awake.size()));
  if (world.steps % world.steps_per_sample != 0) return;
  const double interval = static_cast<double>(world.steps_per_sample) * world.scene.time.step;
  for (BodyIndex ship = 0; ship < world.ship_count(); ++ship) {
    world.journal.samples.push_back(sample_of(world, ship, interval));
    world.loads[ship] = {};
  }
}

}  // namespace polynya::simulation
