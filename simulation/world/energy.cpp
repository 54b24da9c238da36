#include "simulation/world/energy.hpp"

#include <cmath>

namespace polynya::simulation {

using dynamics::BodyIndex;
using geometry::Vector;

namespace {

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

void open_accounts(const dynamics::Bodies& bodies, AuditSums& sums) {
  sums = {};
  sums.initial_energy = kinetic_energy(bodies);
  sums.initial_momentum = momentum(bodies);
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

Audit audit(const AuditSums& sums, double kinetic_energy, Vector momentum) {
  Audit audit;
  audit.sums = sums;
  const EnergyFlows& e = audit.sums.energy;
  const MomentumFlows& m = audit.sums.momentum;
  const BoundaryFlows& b = audit.sums.boundaries;
  audit.kinetic_energy = kinetic_energy;
  const double in = e.thrust + e.current + b.wind + b.walls;
  const double out = e.drag + e.friction + e.restitution + e.crushing + e.bending + e.splitting + e.grinding +
                     e.submersion + e.submerged_ice + e.rest;
  audit.energy_imbalance = audit.kinetic_energy - audit.sums.initial_energy - in + out;
  audit.turnover = audit.sums.initial_energy + std::abs(e.thrust) + std::abs(e.current) + std::abs(b.wind) +
                   std::abs(b.walls) + std::abs(out);
  audit.total_momentum = momentum;
  audit.momentum_imbalance = audit.total_momentum - audit.sums.initial_momentum - m.thrust - m.held - m.water -
                             b.wind_impulse - b.wall_impulse + m.removed;
  audit.momentum_turnover = length(audit.sums.initial_momentum) + audit.sums.impulses;
  return audit;
}

}  // namespace polynya::simulation
