#include "simulation/state/state.hpp"
#include "simulation/state/state_fields.hpp"

namespace polynya::simulation {
namespace {

BodyMotion motion_of(const dynamics::Bodies& bodies, BodyIndex i) {
  return {bodies.position[i],         bodies.angle[i],  bodies.rotation[i],  bodies.velocity[i],
          bodies.angular_velocity[i], bodies.travel[i], bodies.rim_speed[i], bodies.is_awake[i] != 0};
}

Standing standing_of(const Population& population, FloeId id) {
  if (population.is_fast(id)) return Standing::kFast;  // also when it has broken: its pieces follow it
  return population.floes[id].is_under ? Standing::kUnderHull : Standing::kFree;
}

/// A member of all records, in their order. Only the law of crushing ice has these.
template <class Member>
std::vector<Member> members(const std::vector<dynamics::PairState>& pairs,
                            Member dynamics::PersistentContact::*member) {
  std::vector<Member> all;
  for (const dynamics::PairState& pair : pairs)
    for (const dynamics::PersistentContact& record : pair.records) all.push_back(record.*member);
  return all;
}

template <class Archive>
void write(Archive& archive, const World& world, const std::vector<dynamics::PairState>& pairs) {
  const Population& population = world.population;
  archive(world.clock.steps, world.accounts);
  if (world.clock.changing) archive(world.clock.water_drift);
  if (has_wind_or_walls(world.setup.scene)) archive(world.accounts.audit.boundaries);
  archive(std::uint64_t{population.floes.size()});
  for (BodyIndex hull = 0; hull < population.hull_count; ++hull) {
    archive(motion_of(population.bodies, hull));
    if (is_sailing(world.setup, hull)) archive(population.helms[hull], world.accounts.sailing[hull]);
    if (manages_ice(world.setup, hull)) archive(population.helms[hull].memory.pattern);
  }
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    const Floe& floe = population.floes[id];
    archive(FloeHead{floe.parent, floe.born, floe.generation, floe.area, population.is_alive(id),
                     standing_of(population, id)});
    if (!population.is_alive(id)) continue;
    if (floe.parent != kNoFloe) archive(floe.shape.polygon);  // else the scene's
    archive(motion_of(population.bodies, population.body_of(id)));
  }
  archive(population.tilted, population.submerged);
  if (has_flooding_decks(world.setup)) archive(population.decks);
  archive(pairs);
  if (is_crush_law(world.setup)) archive(members(pairs, &dynamics::PersistentContact::crushed));
}

}  // namespace

std::string save_state(const World& world) {
  const std::vector<dynamics::PairState> pairs = world.population.pairs.pair_states();
  std::vector<double> separation_bound;
  separation_bound.reserve(pairs.size());
  for (const dynamics::PairState& pair : pairs) separation_bound.push_back(pair.separation_bound);
  ByteWriter archive;
  write(archive, world, pairs);
  archive(separation_bound);
  if (is_crush_law(world.setup)) archive(members(pairs, &dynamics::PersistentContact::booked));
  archive(world.accounts.masses, world.accounts.counts.unresolved_splits, world.accounts.counts.steps_at_level,
          world.accounts.counts.crowded_ticks, world.clock.finer, world.clock.bends, world.accounts.counts.body_steps,
          world.clock.next_levels);
  archive(world.accounts.load_peaks, world.accounts.panels, members(pairs, &dynamics::PersistentContact::load_track));
  return archive.take();
}

std::uint64_t state_hash(const World& world) {
  HashWriter archive;
  write(archive, world, world.population.pairs.touching_states());
  return archive.hash();
}

}  // namespace polynya::simulation
