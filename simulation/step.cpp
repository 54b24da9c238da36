#include "simulation/step.hpp"

#include <algorithm>
#include <cmath>

#include "simulation/runaway.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

Vector heading_of(const World& world, BodyIndex ship) {
  const geometry::Rotation r = world.bodies.rotation[ship];
  return {r.cosine, r.sine};
}

/// Enters what a held body did to another through their contact.
void enter_prescribed_work(World& world, const dynamics::Contact& c) {
  const Vector on_free = world.bodies.inverse_mass[c.a] == 0 ? c.impulse_on_b() : -c.impulse_on_b();
  world.audit.energy.thrust += c.prescribed_work;
  world.audit.momentum.held += on_free;
  world.audit.impulses += length(on_free);
}

void note_water(World& world, const dynamics::WaterWork& work) {
  world.audit.energy.drag += work.lost;
  world.audit.energy.current += work.by_current;
  world.audit.momentum.water += work.impulse;
  world.audit.impulses += work.impulses;
}

void push_ship(World& world, BodyIndex ship, double thrust) {
  dynamics::Bodies& bodies = world.bodies;
  const Vector impulse = world.scene.time.step * thrust * heading_of(world, ship);
  const Vector change = bodies.inverse_mass[ship] * impulse;
  world.audit.energy.thrust += dot(impulse, bodies.velocity[ship] + 0.5 * change);
  world.audit.momentum.thrust += impulse;
  world.audit.impulses += length(impulse);
  bodies.velocity[ship] += change;
}

/// Enters what is left to a floe that is put to rest.
void note_rest(World& world, BodyIndex i) {
  const dynamics::Bodies& bodies = world.bodies;
  const Vector left = bodies.mass[i] * bodies.velocity[i];
  const double omega = bodies.angular_velocity[i];
  world.audit.energy.rest += 0.5 * (dot(left, bodies.velocity[i]) + bodies.moment[i] * omega * omega);
  world.audit.momentum.removed += left;
  world.audit.impulses += length(left);
}

/// Marks what crushed, once the solver has told which contacts needed all that crushing ice could carry, and
/// enters what all contacts did into the accounts.
void note_crushing(World& world) {
  EnergyFlows& energy = world.audit.energy;
  for (dynamics::Contact& c : world.contacts) {
    const bool is_at_limit = c.is_at_limit();
    (is_at_limit ? energy.crushing : energy.restitution) -= c.normal_work;
    energy.friction -= c.slip_work;
    if (world.bodies.inverse_mass[c.a] == 0 || world.bodies.inverse_mass[c.b] == 0)
      enter_prescribed_work(world, c);
    if (!is_at_limit || c.approach_speed <= 0) continue;
    c.record->crushed_depth = c.depth;
    if (!c.record->has_crushed) ++world.counts.crush_contacts;
    c.record->has_crushed = true;
  }
}

}  // namespace

void find_pairs(World& world) {
  world.pairs.update(world.bodies, world.awake);
}

void find_contacts(World& world) {
  world.pairs.find_contacts(world.bodies, world.scene.time.step, world.contacts, world.threads);
  world.counts.unpaired_stretches += world.pairs.take_unpaired_stretches();
  world.counts.peak_contacts =
      std::max(world.counts.peak_contacts, static_cast<std::int64_t>(world.contacts.size()));
}

void solve_impulses(World& world) {
  if (world.contacts.empty()) return;
  world.solver_settings.threads = world.threads;
  const dynamics::SolverResult result =
      world.solver.solve(world.bodies, world.contacts, world.solver_settings);
  if (!result.is_converged()) ++world.counts.unconverged_steps;
  world.counts.largest_residual = std::max(world.counts.largest_residual, result.residual);
  note_crushing(world);
  for (const dynamics::Contact& c : world.contacts) {
    if (c.total_normal_impulse() == 0) continue;
    wake(world, c.a);
    wake(world, c.b);
  }
}

void apply_forces(World& world) {
  const double dt = world.scene.time.step;
  const WaterSettings& water = world.scene.water;
  note_water(world, apply_water_drag(world.bodies, world.awake,
                                     {water.drag_coefficient, water.water.density, world.current}, dt,
                                     world.threads));
  for (BodyIndex ship = 0; ship < world.ship_count(); ++ship) {
    if (const auto* thrust = std::get_if<ConstantThrust>(&world.scene.ships[ship].propulsion)) {
      push_ship(world, ship, thrust->thrust);
    }
  }
}

void integrate_motion(World& world) {
  const double dt = world.scene.time.step;
  separate(world.bodies, world.contacts, world.separation_settings, dt);
  const double fastest = integrate(world.bodies, world.awake, dt, world.threads);
  if (fastest < kRunawaySpeed || world.failure) return;
  const auto runaway = std::find_if(world.awake.begin(), world.awake.end(), [&](BodyIndex i) {
    return !(world.bodies.rim_speed[i] < kRunawaySpeed);
  });
  world.failure = "body " + std::to_string(*runaway) +
                  " has no finite speed below 1000 m/s at t = " + std::to_string(world.time()) + " s";
}

void put_to_rest(World& world) {
  if (!world.shortcuts.sleeps) return;
  world.touched_at_step.resize(static_cast<std::size_t>(world.bodies.size()), -1);
  for (const dynamics::Contact& c : world.contacts) {
    world.touched_at_step[c.a] = world.steps;
    world.touched_at_step[c.b] = world.steps;
  }
  std::erase_if(world.awake, [&](BodyIndex i) {
    if (world.is_ship(i) || world.touched_at_step[i] == world.steps) return false;
    if (world.bodies.rim_speed[i] >= kRestSpeed) return false;
    if (!world.is_current_still_at(i)) return false;  // for a moment only
    note_rest(world, i);
    world.bodies.velocity[i] = {};
    world.bodies.angular_velocity[i] = 0;
    world.bodies.is_awake[i] = 0;
    world.pairs.sleep(world.bodies, i);
    return true;
  });
}

void step(World& world) {
  find_pairs(world);
  find_contacts(world);
  decide(world);
  solve_impulses(world);
  tally_loads(world);
  apply_forces(world);
  integrate_motion(world);
  ++world.steps;
  note_ship_contacts(world);
  apply_fractures(world);
  put_to_rest(world);
  record(world);
}

}  // namespace polynya::simulation
