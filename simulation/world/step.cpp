#include "simulation/world/step.hpp"

#include <algorithm>
#include <bit>
#include <cmath>

#include "simulation/ice/split_instant.hpp"
#include "simulation/world/levels.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// Enters what bodies of prescribed motion did through their contact.
void enter_prescribed_work(const dynamics::Bodies& bodies, const dynamics::Contact& c, AuditSums& audit) {
  audit.energy.thrust += c.prescribed_work;
  if (bodies.inverse_mass[c.a] == 0 && bodies.inverse_mass[c.b] == 0) return;  // nothing is free to move
  const Vector on_free = bodies.inverse_mass[c.a] == 0 ? c.impulse_on_b() : -c.impulse_on_b();
  audit.momentum.held += on_free;
  audit.impulses += length(on_free);
}

/// Marks what crushed: contacts that needed all that crushing ice can carry. Enters what all contacts did
/// into the accounts.
void enter_contacts(const Setup& setup, const dynamics::Bodies& bodies, std::vector<dynamics::Contact>& contacts,
                    Accounts& accounts) {
  EnergyFlows& energy = accounts.audit.energy;
  double given = 0;
  for (dynamics::Contact& c : contacts) {
    (c.is_at_limit ? energy.crushing : energy.restitution) -= c.normal_work;
    energy.friction -= c.slip_work;
    given += c.normal_work + c.slip_work;
    remember_overlap(c);
    if (is_crush_law(setup)) remember_crushed(bodies, c);
    if (bodies.inverse_mass[c.a] == 0 || bodies.inverse_mass[c.b] == 0)
      enter_prescribed_work(bodies, c, accounts.audit);
    if (!c.is_at_limit || c.approach_speed <= 0) continue;
    c.record->crushed_depth = c.depth;
    if (!c.record->has_crushed) ++accounts.counts.crush_contacts;
    c.record->has_crushed = true;
  }
  accounts.counts.energy_created += std::max(0.0, given);
}

void enter_water(const dynamics::WaterWork& work, AuditSums& audit) {
  audit.energy.drag += work.lost;
  audit.energy.current += work.by_current;
  audit.momentum.water += work.impulse;
  audit.impulses += work.impulses;
}

void blow(Vector stress, Population& population, double dt, AuditSums& audit) {
  const auto first_floe = std::ranges::lower_bound(population.awake, population.hull_count);
  const dynamics::WindWork work = apply_wind(population.bodies, {first_floe, population.awake.end()}, stress, dt);
  audit.boundaries.wind += work.energy;
  audit.boundaries.wind_impulse += work.impulse;
  audit.impulses += work.impulses;
}

void push_ship(dynamics::Bodies& bodies, BodyIndex ship, double thrust_impulse, AuditSums& audit) {
  const Vector heading{bodies.rotation[ship].cosine, bodies.rotation[ship].sine};
  const Vector impulse = thrust_impulse * heading;
  const Vector change = bodies.inverse_mass[ship] * impulse;
  audit.energy.thrust += dot(impulse, bodies.velocity[ship] + 0.5 * change);
  audit.momentum.thrust += impulse;
  audit.impulses += length(impulse);
  bodies.velocity[ship] += change;
}

}  // namespace

void find_pairs(Population& population) {
  population.pairs.update(population.bodies, population.awake);
}

void find_contacts(const Setup& setup, int threads, Population& population, std::vector<dynamics::Contact>& contacts,
                   Counts& counts) {
  population.pairs.find_contacts(population.bodies, setup.step, contacts, threads);
  counts.unpaired_stretches += population.pairs.take_unpaired_stretches();
  counts.peak_contacts = std::max(counts.peak_contacts, static_cast<std::int64_t>(contacts.size()));
}

void solve_impulses(const Setup& setup, int threads, Population& population, StepData& step, Accounts& accounts) {
  step.splits.clear();
  if (step.contacts.empty()) return;
  dynamics::SolverSettings settings = setup.solver;
  settings.threads = threads;
  const dynamics::SolverResult result = solve_to_splits(setup, settings, population, step, accounts.counts);
  if (!result.is_converged()) ++accounts.counts.unconverged_steps;
  accounts.counts.largest_residual = std::max(accounts.counts.largest_residual, result.residual);
  enter_contacts(setup, population.bodies, step.contacts, accounts);
  for (const dynamics::Contact& c : step.contacts) {
    if (c.total_normal_impulse() == 0) continue;
    wake(c.a, population);
    wake(c.b, population);
  }
}

void apply_forces(const Setup& setup, const Clock& clock, int threads, Population& population, AuditSums& audit) {
  const double dt = setup.step;
  const WaterSettings& water = setup.scene.water;
  if (setup.scene.wind.blows()) blow(setup.scene.wind.stress(clock.time()), population, dt, audit);
  enter_water(apply_water_drag(population.bodies, population.awake,
                               {water.drag_coefficient, water.water.density, setup.current, water.drag_area,
                                water.skin_drag_coefficient},
                               dt, threads),
              audit);
  for (std::size_t ship = 0; ship < setup.scene.ships.size(); ++ship) {
    if (const auto* thrust = std::get_if<ConstantThrust>(&setup.scene.ships[ship].propulsion))
      push_ship(population.bodies, static_cast<BodyIndex>(ship), dt * thrust->thrust, audit);
  }
}

std::optional<std::string> integrate_motion(const Setup& setup, const Clock& clock, int threads,
                                            const std::vector<dynamics::Contact>& contacts, Population& population) {
  const double dt = setup.step;
  if (setup.separation) separate(population.bodies, contacts, *setup.separation, dt);
  const double fastest = integrate(population.bodies, population.awake, dt, threads);
  if (fastest < kRunawaySpeed) return std::nullopt;
  const auto runaway = std::ranges::find_if(
      population.awake, [&](BodyIndex i) { return !(population.bodies.rim_speed[i] < kRunawaySpeed); });
  return "body " + std::to_string(*runaway) +
         " has no finite speed below 1000 m/s at t = " + std::to_string(clock.time()) + " s";
}

void put_to_rest(const Setup& setup, const Clock& clock, StepData& step, Population& population, AuditSums& audit) {
  if (!setup.shortcuts.sleeps || !clock.is_at_tick() || clock.steps % setup.steps_per_rest != 0) return;
  dynamics::Bodies& bodies = population.bodies;
  step.touched_at_step.resize(static_cast<std::size_t>(bodies.size()), -1);
  for (const dynamics::Contact& c : step.contacts) {
    step.touched_at_step[c.a] = clock.steps;
    step.touched_at_step[c.b] = clock.steps;
  }
  std::erase_if(population.awake, [&](BodyIndex i) {
    if (population.is_hull(i) || step.touched_at_step[i] == clock.steps) return false;
    if (bodies.rim_speed[i] >= kRestSpeed) return false;
    if (bodies.inverse_mass[i] == 0 && bodies.rim_speed[i] > 0) return false;  // its motion is prescribed
    if (!stays_at_rest(i, setup, bodies)) return false;                        // it would not stay at rest
    stop(bodies, i, audit.energy.rest, audit);
    bodies.is_awake[i] = 0;
    population.pairs.sleep(bodies, i);
    return true;
  });
}

const std::array<Stage, 32> kStages = {{
    {"follow the water", [](World& w) { follow_water(w.setup, w.clock, w.population, w.accounts.audit); }},
    {"steer", [](World& w) { steer(w.setup, w.clock, w.pilots, w.population); }},
    {"press walls", [](World& w) { press_walls(w.setup, w.clock, w.population, w.accounts.audit); }},
    {"keep motion", [](World& w) { keep_motion(w.population, w.step); }},
    {"find pairs", [](World& w) { find_pairs(w.population); }},
    {"find contacts",
     [](World& w) {
       find_contacts(w.setup, w.threads, w.population, w.step.contacts, w.accounts.counts);
       w.population.pairs.take_blind_overlaps(w.step.blind_overlaps);
       w.population.pairs.take_parted(w.step.parted);
     }},
    {"decide", [](World& w) { decide(w.setup, w.clock, w.threads, w.population, w.step, w.accounts.counts); }},
    {"limit by tilt", [](World& w) { limit_by_tilt(w.setup, w.population, w.step); }},
    {"solve impulses", [](World& w) { solve_impulses(w.setup, w.threads, w.population, w.step, w.accounts); }},
    {"hold walls", [](World& w) { hold_walls(w.setup, w.clock, w.population, w.accounts.audit); }},
    {"drop unbroken", [](World& w) { drop_unbroken(w.setup, w.step); }},
    {"enter splits", [](World& w) { enter_splits(w.setup, w.population, w.step); }},
    {"overload",
     [](World& w) {
       auto failure = overload_of(w.setup, w.clock, w.population, w.step);
       if (failure && !w.failure) w.failure = std::move(failure);
     }},
    {"tilt floes", [](World& w) { tilt_floes(w.setup, w.population, w.step); }},
    {"book overlaps", [](World& w) { book_overlaps(w.setup, w.population, w.step); }},
    {"tally loads", [](World& w) { tally_loads(w.population, w.step.contacts, w.step.loads); }},
    {"follow loads",
     [](World& w) {
       follow_loads(w.setup, w.clock, w.population, w.step, w.accounts.load_peaks, w.journal);
       load_panels(w.setup, w.population, w.step, w.accounts.panels);
     }},
    {"water and thrust", [](World& w) { apply_forces(w.setup, w.clock, w.threads, w.population, w.accounts.audit); }},
    {"pull of submerged ice",
     [](World& w) { pull_of_submerged_ice(w.setup, w.population, w.step.loads, w.accounts.audit); }},
    {"sail", [](World& w) { sail(w.setup, w.clock, w.step, w.population, w.accounts); }},
    {"integrate",
     [](World& w) {
       auto failure = integrate_motion(w.setup, w.clock, w.threads, w.step.contacts, w.population);
       if (failure && !w.failure) w.failure = std::move(failure);
     }},
    {"advance the clock", [](World& w) { advance(w.clock); }},
    {"apply fractures",
     [](World& w) { apply_fractures(w.setup, w.clock, w.step.fractures, w.population, w.accounts, w.journal); }},
    {"grind",
     [](World& w) {
       grind_blind_overlaps(w.setup, w.clock, w.step.blind_overlaps, w.population, w.accounts, w.journal);
     }},
    {"carve channels", [](World& w) { carve_channels(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"shed crushed ice",
     [](World& w) { shed_crushed_ice(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"cut through floes",
     [](World& w) { cut_through_floes(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"go under",
     [](World& w) { apply_submersions(w.setup, w.clock, w.step.submersions, w.population, w.accounts, w.journal); }},
    {"come up", [](World& w) { come_up(w.setup, w.clock, w.population, w.accounts, w.journal); }},
    {"record ship events",
     [](World& w) { record_ship_events(w.setup, w.clock, w.population, w.step, w.accounts.ship_contacts, w.journal); }},
    {"put to rest", [](World& w) { put_to_rest(w.setup, w.clock, w.step, w.population, w.accounts.audit); }},
    {"record", [](World& w) { record(w.setup, w.clock, w.population, w.step.loads, w.accounts, w.journal); }},
}};

void step(World& world) {
  Counts& counts = world.accounts.counts;
  const int parts = parts_of_tick(world.setup, world.clock, world.population);
  take_parts(world.setup, world.clock, parts);
  counts.steps_at_level[static_cast<std::size_t>(kMostLevels - std::countr_zero(static_cast<unsigned>(parts)))] +=
      parts;
  const std::int64_t bends = counts.bends;
  for (int part = 0; part < parts; ++part) {
    for (const Stage& stage : kStages) stage.run(world);
    if (world.failure) break;
  }
  while (!world.clock.is_at_tick()) advance(world.clock);  // of a run that cannot continue
  counts.crowded_ticks += follow_bends(world.setup, counts.bends - bends, world.clock);
}

}  // namespace polynya::simulation
