#include "simulation/energy.hpp"

#include <cmath>

#include "simulation/world.hpp"

namespace polynya::simulation {

using geometry::Vector;

namespace {

bool counts(const dynamics::Bodies& bodies, BodyIndex i) {
  return bodies.is_alive[i] != 0 && bodies.inverse_mass[i] != 0;
}

}  // namespace

double kinetic_energy(const World& world) {
  const dynamics::Bodies& bodies = world.bodies;
  double sum = 0;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (!counts(bodies, i)) continue;
    sum += 0.5 * (bodies.mass[i] * squared_length(bodies.velocity[i]) +
                  bodies.moment[i] * bodies.angular_velocity[i] * bodies.angular_velocity[i]);
  }
  return sum;
}

Vector momentum(const World& world) {
  Vector sum;
  for (BodyIndex i = 0; i < world.bodies.size(); ++i) {
    if (counts(world.bodies, i)) sum += world.bodies.mass[i] * world.bodies.velocity[i];
  }
  return sum;
}

void open_accounts(World& world) {
  world.audit = {};
  world.audit.initial_energy = kinetic_energy(world);
  world.audit.initial_momentum = momentum(world);
}

bool Audit::is_closed() const {
  return std::abs(energy_imbalance) <= kTolerance * turnover &&
         length(momentum_imbalance) <= kTolerance * momentum_turnover;
}

Audit audit(const World& world) {
  return audit(world.audit, kinetic_energy(world), momentum(world));
}

Audit audit(const AuditSums& sums, double kinetic_energy, Vector momentum) {
  Audit audit;
  audit.sums = sums;
  const EnergyFlows& e = audit.sums.energy;
  const MomentumFlows& m = audit.sums.momentum;
  audit.kinetic_energy = kinetic_energy;
  const double in = e.thrust + e.current;
  const double out = e.drag + e.friction + e.restitution + e.crushing + e.bending + e.splitting + e.rest;
  audit.energy_imbalance = audit.kinetic_energy - audit.sums.initial_energy - in + out;
  audit.turnover = audit.sums.initial_energy + std::abs(e.thrust) + std::abs(e.current) + std::abs(out);
  audit.total_momentum = momentum;
  audit.momentum_imbalance =
      audit.total_momentum - audit.sums.initial_momentum - m.thrust - m.held - m.water + m.removed;
  audit.momentum_turnover = length(audit.sums.initial_momentum) + audit.sums.impulses;
  return audit;
}

}  // namespace polynya::simulation
