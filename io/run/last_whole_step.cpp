#include "io/run/last_whole_step.hpp"

#include "simulation/world.hpp"

namespace polynya::io {

LastWholeStep::LastWholeStep(const simulation::Simulation& simulation) {
  counts_.floes_final = simulation.counts().floes_final;
  take(simulation, 0);
}

void LastWholeStep::take(const simulation::Simulation& simulation, std::int64_t more_floes) {
  const simulation::World& world = simulation.world();
  const std::int64_t floes = counts_.floes_final + more_floes;
  counts_ = world.accounts.counts;
  counts_.floes_final = floes;
  counts_.steps = world.clock.steps;
  time_ = world.clock.time();
  ledger_ = world.accounts.ledger;
  masses_ = world.accounts.masses;
  sums_ = world.accounts.audit;
}

void LastWholeStep::fill(RunSummary& summary) const {
  summary.counts = counts_;
  summary.steps = counts_.steps;
  summary.sim_time = time_;
  summary.ledger = ledger_;
  summary.ledger.floe_area = ledger_.initial_ice_area + ledger_.rounding_defect - ledger_.submerged_area -
                             ledger_.brash_area - ledger_.under_ice_area;
  summary.ledger.imbalance = 0;
  summary.masses = masses_;
  summary.masses.floe_mass = masses_.initial_ice_mass + masses_.rounding_mass - masses_.submerged_mass -
                             masses_.brash_mass - masses_.under_ice_mass;
  const simulation::Audit at_rest = audit(sums_, 0, {});
  summary.audit = audit(sums_, -at_rest.energy_imbalance, -at_rest.momentum_imbalance);
}

}  // namespace polynya::io
