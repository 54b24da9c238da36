#include "simulation/world/energy.hpp"

#include <array>
#include <cmath>

namespace polynya::simulation {

using dynamics::BodyIndex;
using geometry::Vector;

namespace {

/// Returns true if a body counts in the sums: it exists, and its motion is not prescribed.
bool counts(const dynamics::Bodies& bodies, BodyIndex i) {
  return bodies.is_alive[i] != 0 && bodies.inverse_mass[i] != 0;
}

}  // namespace

double kinetic_energy(const dynamics::Bodies& bodies) {
  double sum = 0;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (!counts(bodies, i)) continue;
    sum += 0.5 * (bodies.mass[i] * squared_length(bodies.velocity[i]) +
                  bodies.moment[i] * bodies.angular_velocity[i] * bodies.angular_velocity[i]);
  }
  return sum;
}

Vector momentum(const dynamics::Bodies& bodies) {
  Vector sum;
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (counts(bodies, i)) sum += bodies.mass[i] * bodies.velocity[i];
  }
  return sum;
}

Holdings holdings(const dynamics::Bodies& bodies, double stored_energy) {
  Holdings sum{kinetic_energy(bodies), stored_energy, momentum(bodies)};
  for (BodyIndex i = 0; i < bodies.size(); ++i) {
    if (counts(bodies, i)) sum.momenta += bodies.mass[i] * length(bodies.velocity[i]);
  }
  return sum;
}

void open_accounts(const Holdings& holdings, AuditSums& sums) {
  sums = {};
  sums.initial_energy = holdings.kinetic_energy;
  sums.moorings.initial = holdings.stored_energy;
  sums.initial_momentum = holdings.momentum;
  sums.initial_momenta = holdings.momenta;
}

namespace {

double inflow(const AuditSums& sums) {
  const BoundaryFlows& b = sums.boundaries;
  return sums.energy.thrust + sums.energy.current + b.wind + b.walls + sums.moorings.ground + sums.moorings.separation;
}

double outflow(const AuditSums& sums) {
  const EnergyFlows& e = sums.energy;
  return e.drag + e.friction + e.restitution + e.crushing + e.bending + e.splitting + e.grinding + e.submersion +
         e.submerged_ice + e.rest + sums.moorings.damping + sums.moorings.breaking;
}

/// All flows of energy, those between ships and springs included [J].
auto all_flows(const AuditSums& sums) {
  const EnergyFlows& e = sums.energy;
  const BoundaryFlows& b = sums.boundaries;
  const MooringFlows& m = sums.moorings;
  return std::array{e.thrust,    e.current,    e.drag,       e.friction,      e.restitution, e.crushing,  e.bending,
                    e.splitting, e.grinding,   e.submersion, e.submerged_ice, e.rest,        b.wind,      b.walls,
                    m.taken_up,  m.given_back, m.ground,     m.damping,       m.breaking,    m.separation};
}

}  // namespace

void enter_exchange(const AuditSums& before, AuditSums& sums) {
  const auto was = all_flows(before), is = all_flows(sums);
  for (std::size_t i = 0; i < is.size(); ++i) sums.exchanged += std::abs(is[i] - was[i]);
}

void enter_motion(const dynamics::Bodies& bodies, BodyIndex floe, double& energy, Vector& momentum, AuditSums& sums) {
  const Vector carried = bodies.mass[floe] * bodies.velocity[floe];
  const double omega = bodies.angular_velocity[floe];
  energy += 0.5 * (dot(carried, bodies.velocity[floe]) + bodies.moment[floe] * omega * omega);
  momentum += carried;
  sums.impulses += length(carried);
}

void stop(dynamics::Bodies& bodies, BodyIndex floe, double& energy_sink, AuditSums& sums) {
  if (counts(bodies, floe)) enter_motion(bodies, floe, energy_sink, sums.momentum.removed, sums);
  bodies.velocity[floe] = {};
  bodies.angular_velocity[floe] = 0;
}

bool Audit::is_closed() const {
  return std::abs(energy_imbalance) <= kTolerance * turnover &&
         length(momentum_imbalance) <= kTolerance * momentum_turnover;
}

Audit audit(const AuditSums& sums, const Holdings& holdings) {
  Audit audit;
  audit.sums = sums;
  const MomentumFlows& m = sums.momentum;
  const BoundaryFlows& b = sums.boundaries;
  audit.kinetic_energy = holdings.kinetic_energy;
  audit.stored_energy = holdings.stored_energy;
  audit.energy_imbalance = holdings.kinetic_energy + holdings.stored_energy - sums.initial_energy -
                           sums.moorings.initial - inflow(sums) + outflow(sums);
  audit.turnover = sums.initial_energy + sums.moorings.initial + sums.exchanged;
  audit.total_momentum = holdings.momentum;
  audit.momentum_imbalance = holdings.momentum - sums.initial_momentum - m.thrust - m.held - m.water - b.wind_impulse -
                             b.wall_impulse + m.removed;
  audit.momentum_turnover = sums.initial_momenta + holdings.momenta + sums.impulses;
  return audit;
}

}  // namespace polynya::simulation
