#include "simulation/world/step.hpp"

#include <algorithm>
#include <cmath>

#include "dynamics/chunks.hpp"
#include "simulation/ice/split_instant.hpp"
#include "simulation/ice/turning.hpp"
#include "simulation/world/levels.hpp"
#include "simulation/world/limits.hpp"

namespace polynya::simulation {
namespace {

using geometry::Vector;

/// Enters what bodies of prescribed motion did through their contact.
void enter_prescribed_work(const dynamics::Bodies& bodies, const dynamics::Contact& c, AuditSums& audit) {
  audit.energy.thrust += c.prescribed_work;
  if (are_prescribed(bodies, c.a, c.b)) return;
  const Vector on_free = bodies.inverse_mass[c.a] == 0 ? c.impulse_on_b() : -c.impulse_on_b();
  audit.momentum.held += on_free;
  audit.impulses += length(on_free);
}

/// Marks what crushed: contacts that needed all that crushing ice can carry. Enters what all contacts did
/// into the accounts.
void enter_contacts(const Setup& setup, int threads, const dynamics::Bodies& bodies,
                    std::vector<dynamics::Contact>& contacts, Accounts& accounts) {
  dynamics::for_contacts(contacts, threads, [&](dynamics::Contact& c, std::size_t) {
    remember_overlap(c);
    if (is_crush_law(setup)) remember_crushed(bodies, c);
  });
  EnergyFlows& energy = accounts.audit.energy;
  double given = 0;
  for (dynamics::Contact& c : contacts) {
    (c.is_at_limit ? energy.crushing : energy.restitution) -= c.normal_work;
    energy.friction -= c.slip_work;
    given += c.normal_work + c.slip_work;
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
  const std::vector<BodyIndex>& due = population.due();
  const auto first_floe = std::ranges::lower_bound(due, population.hull_count);
  const dynamics::WindWork work = apply_wind(population.bodies, {first_floe, due.end()}, stress, dt);
  audit.boundaries.wind += work.energy;
  audit.boundaries.wind_impulse += work.impulse;
  audit.impulses += work.impulses;
}

void push_ship(dynamics::Bodies& bodies, BodyIndex ship, double thrust_impulse, AuditSums& audit) {
  const Vector heading{bodies.rotation[ship].cosine, bodies.rotation[ship].sine};
  const Vector impulse = thrust_impulse * heading;
  audit.energy.thrust += push(bodies, ship, impulse);
  audit.momentum.thrust += impulse;
  audit.impulses += length(impulse);
}

}  // namespace

void find_pairs(int threads, Population& population) {
  population.pairs.update(population.bodies, population.due(), 0, threads);
  if (population.level == 0) population.pairs.update(population.bodies, population.moving_along, 0, threads);
}

void find_contacts(const Setup& setup, int threads, const Components& components, Population& population,
                   StepData& step, Counts& counts) {
  std::vector<dynamics::Contact>& contacts = step.contacts;
  population.pairs.find_contacts(population.bodies, setup.step, contacts, threads, population.level);
  if (population.level != Population::kAllDue) drop_unforeseen(population.bodies, components, contacts, step.met);
  counts.unpaired_stretches += population.pairs.take_unpaired_stretches();
  counts.peak_contacts = std::max(counts.peak_contacts, static_cast<std::int64_t>(contacts.size()));
  population.pairs.take_blind_overlaps(step.blind_overlaps);
  population.pairs.take_parted(step.parted);
}

void solve_impulses(const Setup& setup, int threads, Population& population, StepData& step, Accounts& accounts) {
  step.splits.clear();
  if (step.contacts.empty()) return;
  dynamics::SolverSettings settings = setup.solver;
  settings.threads = threads;
  const dynamics::SolverResult result = solve_to_splits(setup, settings, population, step, accounts.counts);
  if (!result.is_converged()) ++accounts.counts.unconverged_steps;
  accounts.counts.largest_residual = std::max(accounts.counts.largest_residual, result.residual);
  enter_contacts(setup, threads, population.bodies, step.contacts, accounts);
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
  enter_water(apply_water_drag(population.bodies, population.due(),
                               {water.drag_coefficient, water.water.density, setup.current, water.drag_area,
                                water.skin_drag_coefficient},
                               dt, threads),
              audit);
}

void push_ships(const Setup& setup, Population& population, AuditSums& audit) {
  for (std::size_t ship = 0; ship < setup.scene.ships.size(); ++ship) {
    if (const auto* thrust = std::get_if<ConstantThrust>(&setup.scene.ships[ship].propulsion))
      push_ship(population.bodies, static_cast<BodyIndex>(ship), setup.step * thrust->thrust, audit);
  }
}

std::optional<std::string> integrate_motion(const Setup& setup, const Clock& clock, int threads,
                                            const std::vector<dynamics::Contact>& contacts, Population& population) {
  const double dt = setup.step;
  if (setup.separation) separate(population.bodies, contacts, *setup.separation, dt);
  double fastest = integrate(population.bodies, population.due(), dt, threads);
  if (population.level == 0) {  // those that move with the ticks, of longer steps
    const double of_others = integrate(population.bodies, population.moving_along, dt, threads);
    if (!(of_others < fastest)) fastest = of_others;
  }
  if (fastest < kRunawaySpeed) return std::nullopt;
  const auto runaway = std::ranges::find_if(
      population.awake, [&](BodyIndex i) { return !(population.bodies.rim_speed[i] < kRunawaySpeed); });
  return "body " + std::to_string(*runaway) +
         " has no finite speed below 1000 m/s at t = " + std::to_string(clock.time()) + " s";
}

namespace {

/// Keeps the first reason why a run cannot continue.
void fail(std::optional<std::string> failure, World& world) {
  if (failure && !world.failure) world.failure = std::move(failure);
}

bool is_time_to_rest(const Setup& setup, const Clock& clock) {
  return setup.shortcuts.sleeps && clock.is_at_tick() && clock.steps % setup.steps_per_rest == 0;
}

}  // namespace

void note_touches(const Setup& setup, const Clock& clock, const Population& population, StepData& step) {
  if (!is_time_to_rest(setup, clock)) return;
  step.touched_at_step.resize(static_cast<std::size_t>(population.bodies.size()), -1);
  for (const dynamics::Contact& c : step.contacts) {
    step.touched_at_step[c.a] = clock.steps;
    step.touched_at_step[c.b] = clock.steps;
  }
}

void put_to_rest(const Setup& setup, const Clock& clock, const StepData& step, Population& population,
                 AuditSums& audit) {
  if (!is_time_to_rest(setup, clock)) return;
  dynamics::Bodies& bodies = population.bodies;
  std::erase_if(population.awake, [&](BodyIndex i) {
    if (population.is_hull(i) || step.touched_at_step[i] == clock.steps) return false;
    if (bodies.rim_speed[i] >= kRestSpeed) return false;
    if (bodies.inverse_mass[i] == 0 && bodies.rim_speed[i] > 0) return false;  // its motion is prescribed
    if (!stays_at_rest(i, setup, bodies)) return false;                        // it would not stay at rest
    stop(bodies, i, audit.energy.rest, audit);
    bodies.is_awake[i] = 0;
    bodies.level[i] = dynamics::kNoLevel;
    population.pairs.sleep(bodies, i);
    return true;
  });
}

const std::array<Stage, 34> kStages = {{
    {"follow the water", RunsIn::kTicks,
     [](World& w) { follow_water(w.setup, w.clock, w.population, w.accounts.audit); }},
    {"steer", RunsIn::kTicks, [](World& w) { steer(w.setup, w.clock, w.pilots, w.population); }},
    {"press walls", RunsIn::kTicks, [](World& w) { press_walls(w.setup, w.clock, w.population, w.accounts.audit); }},
    {"keep motion", RunsIn::kTicks, [](World& w) { keep_motion(w.population, w.step); }},
    {"find pairs", RunsIn::kAllSteps, [](World& w) { find_pairs(w.threads, w.population); }},
    {"find contacts", RunsIn::kAllSteps,
     [](World& w) { find_contacts(w.setup, w.threads, w.components, w.population, w.step, w.accounts.counts); }},
    {"decide", RunsIn::kAllSteps,
     [](World& w) { decide(w.setup, w.clock, w.threads, w.population, w.step, w.accounts.counts); }},
    {"limit by tilt", RunsIn::kTicks, [](World& w) { limit_by_tilt(w.setup, w.population, w.step); }},
    {"solve impulses", RunsIn::kAllSteps,
     [](World& w) { solve_impulses(w.setup, w.threads, w.population, w.step, w.accounts); }},
    {"hold walls", RunsIn::kTicks, [](World& w) { hold_walls(w.setup, w.clock, w.population, w.accounts.audit); }},
    {"drop unbroken", RunsIn::kAllSteps, [](World& w) { drop_unbroken(w.setup, w.step); }},
    {"enter splits", RunsIn::kAllSteps, [](World& w) { enter_splits(w.setup, w.population, w.step); }},
    {"overload", RunsIn::kAllSteps, [](World& w) { fail(overload_of(w.setup, w.clock, w.population, w.step), w); }},
    {"tilt floes", RunsIn::kTicks, [](World& w) { tilt_floes(w.setup, w.population, w.step); }},
    {"book overlaps", RunsIn::kAllSteps, [](World& w) { book_overlaps(w.setup, w.threads, w.population, w.step); }},
    {"tally loads", RunsIn::kTicks, [](World& w) { tally_loads(w.population, w.step.contacts, w.step.loads); }},
    {"follow loads", RunsIn::kTicks,
     [](World& w) {
       follow_loads(w.setup, w.clock, w.population, w.step, w.accounts.load_peaks, w.journal);
       load_panels(w.setup, w.population, w.step, w.accounts.panels);
     }},
    {"water and wind", RunsIn::kTicks,
     [](World& w) { apply_forces(w.setup, w.clock, w.threads, w.population, w.accounts.audit); }},
    {"thrust", RunsIn::kTicks, [](World& w) { push_ships(w.setup, w.population, w.accounts.audit); }},
    {"pull of submerged ice", RunsIn::kTicks,
     [](World& w) {
       pull_of_submerged_ice(w.setup, w.population, w.step.loads, w.accounts.audit);
       press_decks(w.setup, w.population, w.step.loads, w.accounts.audit);
     }},
    {"sail", RunsIn::kTicks, [](World& w) { sail(w.setup, w.clock, w.step, w.population, w.accounts); }},
    {"integrate", RunsIn::kTicks,
     [](World& w) { fail(integrate_motion(w.setup, w.clock, w.threads, w.step.contacts, w.population), w); }},
    {"advance the clock", RunsIn::kTicks, [](World& w) { advance(w.clock); }},
    {"apply fractures", RunsIn::kAllSteps,
     [](World& w) { apply_fractures(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"grind", RunsIn::kAllSteps,
     [](World& w) {
       grind_blind_overlaps(w.setup, w.clock, w.step.blind_overlaps, w.population, w.accounts, w.journal);
     }},
    {"carve channels", RunsIn::kTicks,
     [](World& w) { carve_channels(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"shed crushed ice", RunsIn::kAllSteps,
     [](World& w) { shed_crushed_ice(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"cut through floes", RunsIn::kTicks,
     [](World& w) { cut_through_floes(w.setup, w.clock, w.step, w.population, w.accounts, w.journal); }},
    {"go under", RunsIn::kTicks,
     [](World& w) { apply_submersions(w.setup, w.clock, w.step.submersions, w.population, w.accounts, w.journal); }},
    {"come up", RunsIn::kTogether, [](World& w) { come_up(w.setup, w.clock, w.population, w.accounts, w.journal); }},
    {"record ship events", RunsIn::kTicks,
     [](World& w) {
       record_hull_contacts(w.setup, w.clock, w.population, w.step, w.accounts.hull_contacts, w.journal);
     }},
    {"note touches", RunsIn::kTicks, [](World& w) { note_touches(w.setup, w.clock, w.population, w.step); }},
    {"put to rest", RunsIn::kTogether,
     [](World& w) { put_to_rest(w.setup, w.clock, w.step, w.population, w.accounts.audit); }},
    {"record", RunsIn::kTicks,
     [](World& w) { record(w.setup, w.clock, w.population, w.step.loads, w.accounts, w.journal); }},
}};

namespace {

/// The stages of a step, for the bodies that are due.
void run_stages(World& world, RunsIn most) {
  Counts& counts = world.accounts.counts;
  const double ticks = world.setup.step / world.clock.tick;
  ++counts.steps_at_level[static_cast<std::size_t>(std::min(std::ilogb(ticks), kMostLevels) + kMostLevels)];
  counts.body_steps += static_cast<std::int64_t>(world.population.due().size());
  for (const Stage& stage : kStages)
    if (stage.in <= most) stage.run(world);
}

/// One tick of what goes by the tick, in its parts.
void run_tick(World& world, RunsIn most) {
  Counts& counts = world.accounts.counts;
  const int parts = parts_of_tick(world.setup, world.clock, world.population);
  take_step(world.setup, world.clock, 1, parts);
  const std::int64_t bends = counts.bends;
  for (int part = 0; part < parts && !world.failure; ++part) run_stages(world, most);
  while (!world.clock.is_at_tick()) advance(world.clock);  // of a run that cannot continue
  counts.crowded_ticks += follow_bends(world.setup, counts.bends - bends, world.clock);
}

/// A block of ticks in which bodies take steps of their own. A longer step begins with what contacts do in it, where
/// all are at its first tick that it concerns; water and wind act, and its bodies move, when it ends. Those that
/// shorter steps meet before they were to, or strike, are brought to the tick at hand. All have come to the same at the
/// block's end.
class Block {
 public:
  Block(World& world, std::int64_t ticks)
      : world_(world), ticks_(static_cast<int>(ticks)), longest_(level_of_block(world.setup)) {}

  void run() {
    world_.step.met.clear();
    bool is_over = false;
    for (int tick = 0; !is_over && tick < ticks_ && !world_.failure; ++tick) {
      for (int level = longest_; level > 0; --level)
        if (tick % ticks_of(level) == 0) begin(level, tick);
      for (int level = longest_; level > 0; --level)
        if (step_of(level).end == tick + 1) end(level, tick, tick + 1);
      step_those_of(0, [&] { run_tick(world_, lags(tick + 1) ? RunsIn::kTicks : RunsIn::kTogether); });
      if (tick + 1 == ticks_) break;
      is_over = !bring_met(tick + 1);
      for (const BodyIndex i : find_struck(world_.setup, world_.population, world_.components)) quicken(i, tick + 1);
      for (int level = longest_; is_over && level > 0; --level) end(level, tick + 1, tick + 1);
    }
    keep_contacts();
    end_block(world_.population);
  }

 private:
  /// The last one of a level, in ticks of the block.
  struct LongerStep {
    int come_to = 0;  ///< where its bodies are, but for those that move along
    int begin = 0;
    int end = 0;
    std::vector<dynamics::Contact> contacts;  ///< where recorded
  };

  int ticks_of(int level) const { return level == longest_ ? ticks_ : ticks_of_level(level); }
  LongerStep& step_of(int level) { return steps_[static_cast<std::size_t>(level)]; }

  /// Works in a step of so many ticks that begins so many before the clock's; the clock stays.
  template <class Work>
  void in_step(int back, int ticks, Work work) {
    const Clock now = world_.clock;
    world_.clock.steps -= back;
    take_step(world_.setup, world_.clock, ticks, 1);
    work();
    world_.clock = now;
  }

  /// What contacts do in a step that begins now.
  void begin(int level, int tick) {
    if (of_level(level).empty()) return;
    LongerStep& step = step_of(level);
    step.begin = tick;
    step.end = std::min(tick + ticks_of(level), ticks_);
    in_step(0, step.end - tick, [&] {
      step_those_of(level, [&] { run_stages(world_, RunsIn::kAllSteps); });
      world_.clock.steps += step.end - tick;
      note_touches(world_.setup, world_.clock, world_.population, world_.step);
    });
    begin_longer(world_.population, level, world_.components);
    if (world_.setup.scene.record.contacts == RecordedContacts::kAll) step.contacts = world_.step.contacts;
  }

  /// Water, wind and motion of a step, up to a tick; the clock is at one of the same or the one before.
  void end(int level, int now, int tick) {
    LongerStep& step = step_of(level);
    const int ticks = tick - step.come_to;
    if (ticks == 0 || of_level(level).empty()) return;
    in_step(now - step.come_to, ticks, [&] { step_those_of(level, [&] { move_longer(); }); });
    step.come_to = tick;
  }

  /// Moves a body of longer steps to the tick that has passed, and with the ticks from then on.
  void bring(BodyIndex i, int tick) {
    const int ticks = tick - step_of(world_.population.bodies.level[i]).come_to;
    moved_.assign(1, i);
    if (ticks > 0) integrate(world_.population.bodies, moved_, ticks * world_.clock.tick);
    move_along(i, world_.population, world_.components);
  }

  /// What bodies of shorter steps met, though it lags behind. Returns whether all of it could be brought: not what was
  /// not there when the block began.
  bool bring_met(int tick) {
    bool are_brought = true;
    for (const BodyIndex i : world_.step.met) {
      if (world_.population.bodies.is_awake[i] == 0 || moves_along(world_.components, i)) continue;
      if (has_node(world_.components, i))
        bring(i, tick);
      else
        are_brought = false;
    }
    world_.step.met.clear();
    return are_brought;
  }

  /// Ends the step of a body that moves along: it goes by the tick from then on.
  void quicken(BodyIndex i, int tick) {
    Population& population = world_.population;
    const int ticks = tick - step_of(population.bodies.level[i]).come_to;
    if (ticks > 0) {
      in_step(ticks, ticks, [&] {
        population.level = population.bodies.level[i];
        population.due_some.assign(1, i);
        apply_forces(world_.setup, world_.clock, 1, population, world_.accounts.audit);
      });
    }
    go_by_tick(i, population, world_.components, [&](BodyIndex other) { bring(other, tick); });
  }

  void move_longer() {
    Population& population = world_.population;
    apply_forces(world_.setup, world_.clock, world_.threads, population, world_.accounts.audit);
    moved_ = population.due_some;
    std::erase_if(moved_, [&](BodyIndex i) { return moves_along(world_.components, i); });
    moved_.swap(population.due_some);
    fail(integrate_motion(world_.setup, world_.clock, world_.threads, world_.step.contacts, population), world_);
    moved_.swap(population.due_some);
  }

  bool lags(int tick) {
    for (int level = 1; level <= longest_; ++level)
      if (!of_level(level).empty() && step_of(level).come_to != tick) return true;
    return false;
  }

  /// Of the longer steps, where recorded.
  void keep_contacts() {
    StepData& kept = world_.step;
    for (int level = 1; level <= longest_; ++level) {
      const LongerStep& step = step_of(level);
      kept.longer_contacts.insert(kept.longer_contacts.end(), step.contacts.begin(), step.contacts.end());
      kept.longer_steps.resize(kept.longer_contacts.size(), (step.end - step.begin) * world_.clock.tick);
    }
  }

  std::vector<BodyIndex>& of_level(int level) { return world_.components.of_level[static_cast<std::size_t>(level)]; }

  template <class Steps>
  void step_those_of(int level, Steps steps) {
    Population& population = world_.population;
    population.level = level;
    population.due_some.swap(of_level(level));
    std::erase_if(population.due_some, [&](BodyIndex i) { return population.bodies.is_awake[i] == 0; });
    steps();
    population.due_some.swap(of_level(level));
  }

  World& world_;
  int ticks_;
  int longest_;                                      ///< level: of the block in one step
  std::array<LongerStep, kMostLevels + 3> steps_{};  ///< by level
  std::vector<BodyIndex> moved_;                     ///< at a step's end
};

}  // namespace

void step(World& world, std::int64_t most_ticks) {
  world.step.longer_contacts.clear();
  world.step.longer_steps.clear();
  const std::int64_t ticks =
      begin_block(world.setup, world.clock, most_ticks, world.threads, world.population, world.components);
  if (ticks == 1)
    run_tick(world, RunsIn::kTogether);
  else
    Block(world, ticks).run();
}

}  // namespace polynya::simulation
