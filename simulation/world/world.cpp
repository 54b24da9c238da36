#include <utility>

#include "simulation/ice/under_hull.hpp"
#include "simulation/ship/mooring.hpp"
#include "simulation/world/step.hpp"

namespace polynya::simulation {

namespace {

/// Puts a floe under a hull, where the scene has it at the start, and records its submersion.
void put_under(FloeId floe, const FloeSpec& spec, World& world) {
  const Instant now = instant_at(world.setup, 0);
  world.journal.events.push_back(submersion_event(now, world.population, {floe, spec.under_ship}));
  go_under(world.setup, now, {floe, spec.under_ship}, world.population, world.accounts);
  world.population.submerged.back().path = spec.under_path;
}

}  // namespace

World::World(Scene scene, Shortcuts shortcuts, Start start)
    : floes_at_start(std::exchange(scene.floes, {})),
      setup(std::move(scene), shortcuts),
      clock{.tick = setup.scene.time.step},
      population(setup, floes_at_start) {
  accounts.loads.resize(hull_count(setup.scene));
  accounts.panels = panels_of(setup);
  accounts.sailing.resize(setup.scene.ships.size());
  population.helms.resize(setup.scene.ships.size());
  if (start == Start::kEmpty) return;
  std::vector<FloeSpec> floes = std::exchange(floes_at_start, {});
  add_scene(setup, floes, population, journal);
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    accounts.areas.initial += population.floes[id].area;
    accounts.masses.initial += population.bodies.mass[population.body_of(id)];
  }
  accounts.counts.floes_initial = population.floe_count();
  initialize_helms(setup, step_of(setup, clock, 0, 1), population);
  const double stored = stored_in_moorings(setup, population, drift_at(setup, 0));
  open_accounts(holdings(population.bodies, stored), accounts.audit);
  const AuditSums at_start = accounts.audit;
  for (std::size_t i = 0; i < floes.size(); ++i)
    if (floes[i].under_ship >= 0) put_under(static_cast<FloeId>(i), floes[i], *this);
  enter_exchange(at_start, accounts.audit);
}

namespace {

/// Returns the ledger of the ice that is gone, plus amount_of(id) of each floe that exists now.
template <class AmountOf>
IceLedger ledger_of(IceLedger gone, const Population& population, AmountOf amount_of) {
  for (FloeId id = 0; id < population.floe_count(); ++id)
    if (population.is_alive(id)) (population.floes[id].is_under ? gone.under_hulls : gone.floes) += amount_of(id);
  return gone;
}

}  // namespace

IceLedger area_ledger(const World& world) {
  return ledger_of(world.accounts.areas, world.population, [&](FloeId id) { return world.population.floes[id].area; });
}

IceLedger mass_ledger(const World& world) {
  return ledger_of(world.accounts.masses, world.population,
                   [&](FloeId id) { return world.population.bodies.mass[world.population.body_of(id)]; });
}

}  // namespace polynya::simulation
