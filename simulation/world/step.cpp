#include "simulation/world/step.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/chunks.hpp"
#include "dynamics/contact/paid_overlap.hpp"
#include "simulation/ice/split_instant.hpp"
#include "simulation/ice/turning.hpp"
#include "simulation/ship/mooring.hpp"
#include "simulation/world/limits.hpp"
#include "simulation/world/parts.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// Adds the work and impulse of a body of prescribed motion on the other body of its contact to the accounts.
void enter_prescribed_work(const dynamics::Bodies& bodies, const dynamics::Contact& c, AuditSums& audit) {
  audit.energy.thrust += c.prescribed_work;
  if (are_prescribed(bodies, c.a, c.b)) return;
  const Vector on_free = bodies.inverse_mass[c.a] == 0 ? c.impulse_on_b() : -c.impulse_on_b();
  audit.momentum.held += on_free;
  audit.impulses += length(on_free);
}

/// Adds the work of all contacts to the accounts. Net work that contacts gave to the bodies is a numerical error, and
/// counts as Counts::energy_created. A contact whose ice crushed (Contact::is_at_limit) while its bodies approached
/// each other is marked as crushed.
void enter_contacts(const dynamics::Bodies& bodies, std::vector<dynamics::Contact>& contacts, Accounts& accounts) {
  EnergyFlows& energy = accounts.audit.energy;
  double given = 0;
  for (dynamics::Contact& c : contacts) {
    (c.is_at_limit ? energy.crushing : energy.restitution) -= c.normal_work - c.restored_work;
    energy.restitution -= c.restored_work;
    energy.friction -= c.slip_work;
    given += c.normal_work + c.slip_work - c.restored_work;
    if (bodies.inverse_mass[c.a] == 0 || bodies.inverse_mass[c.b] == 0)
      enter_prescribed_work(bodies, c, accounts.audit);
    if (!c.is_at_limit || c.approach_speed <= 0) continue;
    c.record->crushed_depth = c.depth;
    if (!c.record->has_crushed) ++accounts.counts.crush_contacts;
    c.record->has_crushed = true;
  }
  accounts.counts.energy_created += std::max(0.0, given);
}

/// Counts an unconverged step and the residual of the contact solver.
void count(const dynamics::SolverResult& result, Counts& counts) {
  if (!result.is_converged()) ++counts.unconverged_steps;
  counts.largest_residual = std::max(counts.largest_residual, result.residual);
}

/// Wakes the bodies of all contacts that pressed. A sleeping floe that is touched without an impulse stays asleep.
void wake_pressed(const std::vector<dynamics::Contact>& contacts, Population& population) {
  for (const dynamics::Contact& c : contacts) {
    if (c.total_normal_impulse() == 0) continue;
    wake(c.a, population);
    wake(c.b, population);
  }
}

/// Returns true if more than half of the smaller body of a contact lies within the other. One body then passes through
/// the other (Counts::passing_steps).
bool is_passing(const Setup& setup, const Population& population, const dynamics::Contact& c) {
  const auto area_of = [&](BodyIndex body) {
    return population.is_hull(body) ? setup.waterlines[static_cast<std::size_t>(body)].area
                                    : population.floes[static_cast<std::size_t>(population.floe_of(body))].area;
  };
  return c.area > 0.5 * std::min(area_of(c.a), area_of(c.b));
}

/// Adds the work and impulse of the water to the accounts.
void enter_water(const dynamics::WaterWork& work, AuditSums& audit) {
  audit.energy.drag += work.lost;
  audit.energy.current += work.by_current;
  audit.momentum.water += work.impulse;
  audit.impulses += work.impulses;
}

/// Applies the wind's stress on the ice [Pa] to the awake floes over dt [s], and adds its work to the accounts.
void blow(Vector stress, Population& population, double dt, AuditSums& audit) {
  const std::vector<BodyIndex>& awake = population.awake;
  const auto first_floe = std::ranges::lower_bound(awake, population.hull_count);
  const dynamics::WindWork work = apply_wind(population.bodies, {first_floe, awake.end()}, stress, dt);
  audit.boundaries.wind += work.energy;
  audit.boundaries.wind_impulse += work.impulse;
  audit.impulses += work.impulses;
}

/// Applies an impulse in a ship's frame [N s, N m s], and adds its work to the accounts as that of a thrust.
void push_ship(dynamics::Bodies& bodies, BodyIndex ship, dynamics::Planar in_ship, AuditSums& audit) {
  if (bodies.inverse_mass[ship] == 0) return;
  const Vector impulse = rotate(bodies.rotation[ship], {in_ship.surge, in_ship.sway});
  audit.energy.thrust += push(bodies, ship, impulse, in_ship.yaw);
  audit.momentum.thrust += impulse;
  audit.impulses += length(impulse);
}

}  // namespace

void find_pairs(const Step& step, Population& population) {
  // Contacts are found at the start of the step, so the boxes need no time ahead; next_parts() uses a whole tick.
  population.pairs.update(population.bodies, population.awake, 0, step.threads);
}

void find_contacts(const Step& step, Population& population, StepData& data, Counts& counts) {
  std::vector<dynamics::Contact>& contacts = data.contacts;
  population.pairs.find_contacts(population.bodies, step.length, contacts, step.threads);
  counts.unpaired_stretches += population.pairs.take_unpaired_stretches();
  counts.peak_contacts = std::max(counts.peak_contacts, static_cast<std::int64_t>(contacts.size()));
  population.pairs.take_inseparable_overlaps(data.inseparable_overlaps);
  population.pairs.take_parted(data.parted);
}

void solve_crushing(const Setup& setup, const Step& step, Population& population, StepData& data, Accounts& accounts) {
  count(solve_to_splits(setup, step, population, data, accounts.counts), accounts.counts);
  dynamics::for_contacts(data.contacts, step.threads, [&](dynamics::Contact& c, std::size_t) {
    settle(are_prescribed(population.bodies, c.a, c.b), c);
    remember_crushed(population.bodies, c);
  });
  enter_contacts(population.bodies, data.contacts, accounts);
  wake_pressed(data.contacts, population);
}

void solve_collisions(const Setup& setup, const Step& step, Population& population, StepData& data,
                      Accounts& accounts) {
  dynamics::SolverSettings settings = setup.solver;
  settings.threads = step.threads;
  const dynamics::RestitutionLaw law{setup.scene.contact.restitution, step.length};
  count(data.solver.solve(population.bodies, data.contacts, law, settings), accounts.counts);
  find_splits(setup, step, population, data.contacts, data.splits);
  dynamics::for_contacts(data.contacts, step.threads, [&](dynamics::Contact& c, std::size_t) { settle_collision(c); });
  const auto passes = [&](const dynamics::Contact& c) { return is_passing(setup, population, c); };
  accounts.counts.passing_steps += std::ranges::any_of(data.contacts, passes) ? 1 : 0;
  enter_contacts(population.bodies, data.contacts, accounts);
  wake_pressed(data.contacts, population);
}

void apply_forces(const Setup& setup, const Step& step, Population& population, AuditSums& audit) {
  const WaterSettings& water = setup.scene.water;
  if (setup.scene.wind.blows()) blow(setup.scene.wind.stress(step.begin.time), population, step.length, audit);
  enter_water(apply_water_drag(population.bodies, population.awake,
                               {water.drag_coefficient, water.water.density, setup.current, water.drag_area,
                                water.skin_drag_coefficient},
                               step.length, step.threads),
              audit);
}

void push_ships(const Setup& setup, const Step& step, std::span<const dynamics::Planar> external_forces,
                Population& population, AuditSums& audit) {
  for (std::size_t ship = 0; ship < setup.scene.ships.size(); ++ship) {
    const auto body = static_cast<BodyIndex>(ship);
    if (const auto* thrust = std::get_if<ConstantThrust>(&setup.scene.ships[ship].propulsion))
      push_ship(population.bodies, body, {step.length * thrust->thrust, 0, 0}, audit);
    if (ship < external_forces.size()) push_ship(population.bodies, body, step.length * external_forces[ship], audit);
  }
}

void separate_overlaps(const Setup& setup, const Step& step, const StepData& data, Population& population,
                       AuditSums& audit) {
  const double before = stored_after(setup, step, population);
  separate(population.bodies, data.contacts, {.time = setup.scene.contact.separation_time}, step.length);
  audit.moorings.separation += stored_after(setup, step, population) - before;
}

std::optional<std::string> integrate_motion(const Step& step, Population& population) {
  const double fastest = integrate(population.bodies, population.awake, step.length, step.threads);
  if (fastest < kRunawaySpeed) return std::nullopt;
  const auto runaway = std::ranges::find_if(
      population.awake, [&](BodyIndex i) { return !(population.bodies.rim_speed[i] < kRunawaySpeed); });
  return "body " + std::to_string(*runaway) +
         " has no finite speed below 1000 m/s at t = " + std::to_string(step.begin.time) + " s";
}

void put_to_rest(const Setup& setup, const StepData& data, Population& population, AuditSums& audit) {
  dynamics::Bodies& bodies = population.bodies;
  std::vector<std::uint8_t> touches(static_cast<std::size_t>(bodies.size()), 0);
  for (const dynamics::Contact& c : data.contacts) touches[c.a] = touches[c.b] = 1;
  std::erase_if(population.awake, [&](BodyIndex i) {
    if (population.is_hull(i) || touches[i] != 0) return false;
    if (bodies.rim_speed[i] >= kRestSpeed) return false;
    if (bodies.inverse_mass[i] == 0 && bodies.rim_speed[i] > 0) return false;  // moving fast ice keeps its motion
    if (!stays_at_rest(i, setup, bodies)) return false;                        // wind or current would move the floe
    stop(bodies, i, audit.energy.rest, audit);
    bodies.is_awake[i] = 0;
    population.pairs.sleep(bodies, i);
    return true;
  });
}

namespace {

/// Stores the reason why the run cannot continue, unless an earlier one is stored.
void fail(std::optional<std::string> failure, World& world) {
  if (failure && !world.failure) world.failure = std::move(failure);
}

// The stages of a step. Each calls its function with the members of the world that the function reads and changes.

constexpr Stage kFollowWater{"follow the water",
                             [](World& w, const Step& s) { follow_water(w.setup, s, w.population, w.accounts.audit); }};
constexpr Stage kSteer{"steer", [](World& w, const Step& s) { steer(w.setup, s, w.pilots, w.population); }};
constexpr Stage kPressWalls{"press walls",
                            [](World& w, const Step& s) { press_walls(w.setup, s, w.population, w.accounts.audit); }};
constexpr Stage kStoreMotion{"store motion", [](World& w, const Step&) { store_motion(w.population, w.data); }};
constexpr Stage kFindPairs{"find pairs", [](World& w, const Step& s) { find_pairs(s, w.population); }};
constexpr Stage kFindContacts{
    "find contacts", [](World& w, const Step& s) { find_contacts(s, w.population, w.data, w.accounts.counts); }};
constexpr Stage kDecideByCrushing{
    "decide", [](World& w, const Step& s) { decide_by_crushing(w.setup, s, w.population, w.data); }};
constexpr Stage kDecideByCollision{
    "decide", [](World& w, const Step& s) { decide_by_collision(w.setup, s, w.population, w.data); }};
constexpr Stage kLimitByTilt{"limit by tilt",
                             [](World& w, const Step& s) { limit_by_tilt(w.setup, s, w.population, w.data); }};
constexpr Stage kSolveCrushing{
    "solve impulses", [](World& w, const Step& s) { solve_crushing(w.setup, s, w.population, w.data, w.accounts); }};
constexpr Stage kSolveCollisions{
    "solve impulses", [](World& w, const Step& s) { solve_collisions(w.setup, s, w.population, w.data, w.accounts); }};
constexpr Stage kConstrainWalls{
    "constrain walls", [](World& w, const Step&) { constrain_walls(w.setup, w.population, w.accounts.audit); }};
constexpr Stage kDropUnreachedBends{"drop unreached bends",
                                    [](World& w, const Step&) { drop_unreached_bends(w.data); }};
constexpr Stage kEnterSplits{"enter splits",
                             [](World& w, const Step& s) { enter_splits(w.setup, s, w.population, w.data); }};
constexpr Stage kOverload{"overload",
                          [](World& w, const Step& s) { fail(overload_of(w.setup, s, w.population, w.data), w); }};
constexpr Stage kTiltFloes{"tilt floes", [](World& w, const Step& s) { tilt_floes(w.setup, s, w.population, w.data); }};
constexpr Stage kBookOverlaps{"book overlaps",
                              [](World& w, const Step& s) { book_overlaps(w.setup, s, w.population, w.data); }};
constexpr Stage kTallyLoads{"tally loads",
                            [](World& w, const Step&) { tally_loads(w.population, w.data.contacts, w.data.loads); }};
constexpr Stage kFollowLoads{"follow loads", [](World& w, const Step& s) {
                               follow_loads(w.setup, s, w.population, w.data, {w.accounts, w.journal});
                               load_panels(w.setup, s, w.population, w.data, w.accounts.panels);
                             }};
constexpr Stage kForces{"water and wind",
                        [](World& w, const Step& s) { apply_forces(w.setup, s, w.population, w.accounts.audit); }};
constexpr Stage kThrust{"thrust", [](World& w, const Step& s) {
                          push_ships(w.setup, s, w.external_forces, w.population, w.accounts.audit);
                        }};
constexpr Stage kSubmergedIce{"pull of submerged ice", [](World& w, const Step& s) {
                                pull_of_submerged_ice(w.setup, s, w.population, w.data.loads, w.accounts.audit);
                                accelerate_cusps(s, w.population, w.data.loads, w.accounts.audit);
                                press_decks(w.setup, s, w.population, w.data.loads, w.accounts.audit);
                              }};
constexpr Stage kSail{"sail", [](World& w, const Step& s) { sail(w.setup, s, w.data, w.population, w.accounts); }};
constexpr Stage kSeparate{
    "separate", [](World& w, const Step& s) { separate_overlaps(w.setup, s, w.data, w.population, w.accounts.audit); }};
constexpr Stage kIntegrate{"integrate", [](World& w, const Step& s) { fail(integrate_motion(s, w.population), w); }};
constexpr Stage kApplyFractures{"apply fractures", [](World& w, const Step& s) {
                                  apply_fractures(w.setup, s, w.data, w.population, {w.accounts, w.journal});
                                }};
constexpr Stage kGrind{"grind", [](World& w, const Step& s) {
                         grind_inseparable_overlaps(w.setup, s, w.data, w.population, {w.accounts, w.journal});
                       }};
constexpr Stage kCarve{"carve channels", [](World& w, const Step& s) {
                         carve_channels(w.setup, s, w.data, w.population, {w.accounts, w.journal});
                       }};
constexpr Stage kShed{"shed crushed ice", [](World& w, const Step& s) {
                        shed_crushed_ice(w.setup, s, w.data, w.population, {w.accounts, w.journal});
                      }};
constexpr Stage kCutThrough{"cut through floes", [](World& w, const Step& s) {
                              cut_through_floes(w.setup, s, w.data, w.population, {w.accounts, w.journal});
                            }};
constexpr Stage kGoUnder{"go under", [](World& w, const Step& s) {
                           apply_submersions(w.setup, s, w.data, w.population, {w.accounts, w.journal});
                         }};
constexpr Stage kSurface{"surface", [](World& w, const Step& s) {
                           surface_ice(w.setup, s, w.population, {w.accounts, w.journal});
                         }};
constexpr Stage kHullContacts{"record ship events", [](World& w, const Step& s) {
                                record_hull_contacts(w.setup, s, w.population, w.data, {w.accounts, w.journal});
                              }};
constexpr Stage kSumLoads{"sum loads", [](World& w, const Step& s) { sum_loads(s, w.data, w.accounts); }};

constexpr std::array kCrushStages{kFollowWater,
                                  kSteer,
                                  kPressWalls,
                                  kStoreMotion,
                                  kForces,
                                  kThrust,
                                  kFindPairs,
                                  kFindContacts,
                                  kDecideByCrushing,
                                  kLimitByTilt,
                                  kSolveCrushing,
                                  kConstrainWalls,
                                  kDropUnreachedBends,
                                  kEnterSplits,
                                  kOverload,
                                  kTiltFloes,
                                  kBookOverlaps,
                                  kTallyLoads,
                                  kFollowLoads,
                                  kSubmergedIce,
                                  kSail,
                                  kIntegrate,
                                  kApplyFractures,
                                  kGrind,
                                  kCarve,
                                  kShed,
                                  kGoUnder,
                                  kSurface,
                                  kHullContacts,
                                  kSumLoads};

constexpr std::array kImpulseStages{
    kFollowWater, kSteer,           kPressWalls,     kStoreMotion,  kFindPairs, kFindContacts, kDecideByCollision,
    kLimitByTilt, kSolveCollisions, kConstrainWalls, kEnterSplits,  kTiltFloes, kTallyLoads,   kFollowLoads,
    kForces,      kThrust,          kSubmergedIce,   kSail,         kSeparate,  kIntegrate,    kApplyFractures,
    kGrind,       kGoUnder,         kSurface,        kHullContacts, kSumLoads};

/// Interval at which floes pierced by hulls are examined for a cut [s]. With longer intervals, a floe stays one piece
/// for longer although a hull has come through it. Shorter intervals cost more trial cuts of large plates that still
/// hold together elsewhere.
constexpr double kCutThroughInterval = 0.25;
/// Interval at which floes without motion or contacts are put to sleep by the law of crushing ice [s]. A plate that a
/// ship breaks has no motion and no contact most of the time. With a short interval, the plate would fall asleep
/// between its contacts, lose its pairs with the floes around it, and search for them again. With a long interval,
/// floes at rest stay awake, which costs time. By the law of impulses, floes are put to sleep in every tick, as in the
/// repetitions of the runs of [Sawamura2017].
constexpr double kRestInterval = 1;

}  // namespace

std::span<const Stage> stages_of(ContactLaw law) {
  if (law == ContactLaw::kCrush) return kCrushStages;
  return kImpulseStages;
}

Step step_of(const Setup& setup, const Clock& clock, int part, int parts) {
  const auto time_after = [&](int count) {
    const double share = count == parts ? 1 : static_cast<double>(count) / parts;
    return (static_cast<double>(clock.ticks) + share) * clock.tick;
  };
  Step step;
  step.begin = instant_at(setup, time_after(part));
  step.end = instant_at(setup, time_after(part + 1));
  step.length = clock.tick / parts;
  step.whole_ticks = clock.ticks + (part + 1 == parts ? 1 : 0);
  const WaterSettings& water = setup.scene.water;
  step.water_velocity = water.is_steady() ? water.drift_at(0) : (step.end.drift - step.begin.drift) / step.length;
  return step;
}

// enter_exchange() adds the change of each energy flow to the sum to which the audit compares its imbalance.
void end_tick(World& w) {
  const bool crushes = w.setup.scene.contact.law == ContactLaw::kCrush;
  const AuditSums before = w.accounts.audit;
  if (crushes && is_due(w.clock, kCutThroughInterval)) kCutThrough.run(w, w.last_step);
  if (w.setup.shortcuts.sleeps && is_due(w.clock, crushes ? kRestInterval : w.clock.tick))
    put_to_rest(w.setup, w.data, w.population, w.accounts.audit);
  enter_exchange(before, w.accounts.audit);
  w.accounts.counts.peak_awake =
      std::max(w.accounts.counts.peak_awake, static_cast<std::int64_t>(w.population.awake.size()));
  if (is_due(w.clock, w.setup.scene.record.forces_interval))
    sample_loads(w.setup, w.clock, w.population, {w.accounts, w.journal});
}

namespace {

bool takes_parts(const Setup& setup) {
  return setup.scene.contact.law == ContactLaw::kCrush && setup.shortcuts.takes_parts;
}

/// Returns the number of parts of the next tick. Before that it updates the pairs of bodies for the whole tick, because
/// the number depends on the ice that a hull may reach in the tick.
int next_parts(World& world) {
  const Setup& setup = world.setup;
  if (!takes_parts(setup)) return 1;
  Population& population = world.population;
  population.pairs.update(population.bodies, population.awake, world.clock.tick, world.threads);
  return parts_of_tick(setup, world.pace, population);
}

}  // namespace

// If a stage sets World::failure, the other stages of that part still run, and the tick ends without its later parts.
void step(World& world) {
  const ContactLaw law = world.setup.scene.contact.law;
  Counts& counts = world.accounts.counts;
  const int parts = next_parts(world);
  const std::int64_t bends = counts.bends;
  for (int part = 0; part < parts && !world.failure; ++part) {
    world.last_step = step_of(world.setup, world.clock, part, parts);
    world.last_step.threads = world.threads;
    counts.body_steps += static_cast<std::int64_t>(world.population.awake.size());
    const AuditSums before = world.accounts.audit;
    for (const Stage& stage : stages_of(law)) stage.run(world, world.last_step);
    ++counts.steps_taken;
    enter_exchange(before, world.accounts.audit);
  }
  ++world.clock.ticks;
  counts.most_parts = std::max<std::int64_t>(counts.most_parts, parts);
  end_tick(world);
  if (takes_parts(world.setup)) counts.crowded_ticks += follow_bends(parts, counts.bends - bends, world.pace) ? 1 : 0;
}

}  // namespace polynya::simulation
