#include "dynamics/contact/restitution_law.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Vector;

/// Friction while sliding can raise the impulse that ends an approach above the frictionless one; seldom to
/// twice it. Smaller, sliding contacts give back less than ε; greater, a squeeze from elsewhere charges
/// contacts that it then drives apart.
constexpr double kFrictionSlack = 2;

/// How much of an unconverged step's impulses the next one starts from: a wrong start must decay, not grow.
/// From 1 on it does not decay.
constexpr double kTrustUnconverged = 0.5;

/// Keeps the compression, and predicts that of the next step: steady or falling in proportion, never more
/// than the last two.
void remember_compression(const ContactConstraint& constraint, bool is_converged, PersistentContact& record) {
  for (int end = 0; end < 2; ++end) {
    const double last = record.last_impulse[end];
    const double now = constraint.normal_impulse[end];
    const double start = now < last ? now * (now / last) : last;
    record.restitution.start_impulse[end] = is_converged ? start : kTrustUnconverged * start;
    record.last_impulse[end] = now;
  }
}

}  // namespace

void begin_substep(const RestitutionLaw& law, const ConstraintSpeeds& before, bool /*is_first*/,
                   RestitutionLaw::State& state, ContactConstraint& constraint) {
  constraint.limit = 0.5 * state.crushing_impulse;
  if (state.record == nullptr) return;
  double& limit = state.record->restitution.limit;
  limit = std::max(limit, kFrictionSlack * law.restitution * isolated_impulse(constraint, before));
}

bool restore(const RestitutionLaw& law, bool is_converged, RestitutionLaw::State& state, ContactConstraint& constraint,
             std::span<SolverBody> solver_bodies) {
  PersistentContact* const record = state.record;
  const double compression = constraint.normal_impulse[0] + constraint.normal_impulse[1];
  double owed = law.restitution * compression;
  if (record != nullptr) {
    const RestitutionMemory& memory = record->restitution;
    owed = std::min(owed + memory.owed_impulse, memory.limit - memory.given_impulse);
    remember_compression(constraint, is_converged, *record);
  }
  if (owed <= 0) return false;
  double given[2];
  double still_owed = 0;
  const double owed_per_compression = compression > 0 ? owed / compression : 0;
  for (int end = 0; end < 2; ++end) {
    const double share = compression > 0 ? owed_per_compression * constraint.normal_impulse[end] : 0.5 * owed;
    constraint.least[end] = std::min(constraint.normal_impulse[end] + share, constraint.limit);
    given[end] = constraint.least[end] - constraint.normal_impulse[end];
    still_owed += share - given[end];
    constraint.normal_impulse[end] = constraint.least[end];
  }
  apply_impulses(constraint, given[0], given[1], 0, solver_bodies);
  if (record != nullptr) {
    record->restitution.owed_impulse = still_owed;
    record->restitution.given_impulse += owed - still_owed;
  }
  return given[0] > 0 || given[1] > 0;
}

int separate(Bodies& bodies, const std::vector<Contact>& contacts, const SeparationSettings& settings, double dt) {
  // Each contact moves its own bodies by its own share, one after the other: a relaxation, not a solution,
  // since this overlap is a few centimetres that may take a second to decay.
  int moved = 0;
  const double share = std::min(1.0, dt / settings.time);
  for (const Contact& c : contacts) {
    const double excess = c.depth - std::max(settings.slop, c.record != nullptr ? c.record->crushed_depth : 0.0);
    if (excess <= 0) continue;
    const Vector arm_a = c.middle() - bodies.position[c.a];
    const Vector arm_b = c.middle() - bodies.position[c.b];
    const Mobility a{bodies.inverse_mass[c.a], bodies.inverse_moment[c.a], arm_a};
    const Mobility b{bodies.inverse_mass[c.b], bodies.inverse_moment[c.b], arm_b};
    const double p = share * excess * effective_mass(a, b, c.normal);  // [kg m]: an impulse times a second
    move_body(bodies, c.a, -p * a.inverse_mass * c.normal, -p * a.inverse_moment * cross(arm_a, c.normal));
    move_body(bodies, c.b, p * b.inverse_mass * c.normal, p * b.inverse_moment * cross(arm_b, c.normal));
    ++moved;
  }
  return moved;
}

}  // namespace polynya::dynamics
