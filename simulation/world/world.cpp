#include <utility>

#include "simulation/world/step.hpp"

namespace polynya::simulation {

World::World(Scene scene, Shortcuts shortcuts, Start start)
    : setup(std::move(scene), shortcuts),
      clock{.tick = setup.scene.time.step, .step = setup.scene.time.step, .water_drift = setup.scene.water.drift},
      population(setup) {
  accounts.loads.resize(hull_count(setup.scene));
  accounts.sailing.resize(setup.scene.ships.size());
  population.helms.resize(setup.scene.ships.size());
  if (start == Start::kEmpty) return;
  add_scene(setup, std::exchange(setup.scene.floes, {}), clock, population, journal);
  for (FloeId id = 0; id < population.floe_count(); ++id) {
    accounts.ledger.initial_ice_area += population.floes[id].area;
    accounts.masses.initial_ice_mass += population.bodies.mass[population.body_of(id)];
  }
  accounts.counts.floes_initial = population.floe_count();
  take_helms(setup, clock, population);
  open_accounts(population.bodies, accounts.audit);
}

}  // namespace polynya::simulation
