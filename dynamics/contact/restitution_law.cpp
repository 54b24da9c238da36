#include "dynamics/contact/restitution_law.hpp"

namespace polynya::dynamics {
namespace {

using geometry::Vector;

/// Largest ratio of the impulse that ends an approach with sliding friction to the frictionless one [-]; friction
/// seldom doubles it. Smaller: sliding contacts give back less than ε. Larger: pressure from elsewhere charges
/// contacts, which it then drives apart.
constexpr double kFrictionSlack = 2;

/// Fraction of the impulses of an unconverged step from which the next step starts [-]. A wrong start must decay, so it
/// must be below 1.
constexpr double kTrustUnconverged = 0.5;

/// Stores the compression and predicts the compression of the next step: constant, or falling in proportion, and never
/// more than in the last two steps.
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

double energy_taken(const ConstraintSpeeds& before, const ConstraintSpeeds& after,
                    const ContactConstraint& constraint) {
  double work = 0.5 * constraint.slip_impulse * (before.slip + after.slip);
  for (int end = 0; end < 2; ++end)
    work += 0.5 * constraint.normal_impulse[end] * (before.apart[end] + after.apart[end]);
  return -work;
}

namespace {

/// Work of a fraction `share` of given normal impulses on two bodies, share² · square + share · rate [J].
struct WorkOfShare {
  double square, rate;

  double of(double share) const { return share * (share * square + rate); }
  /// Returns the largest share up to 1 whose work is at most `most`, ≥ 0 [J].
  double largest_within(double most) const {
    if (of(1) <= most) return 1;
    // The work rises from 0, or falls first, and exceeds `most` at 1: the larger root. This form avoids a difference
    // of nearly equal numbers if `most` is small.
    const double root = std::sqrt(rate * rate + 4 * square * most);
    return rate > 0 ? 2 * most / (rate + root) : (root - rate) / (2 * square);
  }
};

WorkOfShare work_of(const ContactConstraint& k, const double (&given)[2], std::span<const SolverBody> solver_bodies) {
  const std::array<double, 2> apart = apart_at(k, solver_bodies[k.a], solver_bodies[k.b]);
  const double square =
      0.5 * (given[0] * given[0] * k.inverse_mass_at[0] + given[1] * given[1] * k.inverse_mass_at[1]) +
      given[0] * given[1] * k.inverse_mass_between;
  return {square, given[0] * apart[0] + given[1] * apart[1]};
}

}  // namespace

bool restore(const RestitutionLaw& law, bool is_converged, double& stored, RestitutionLaw::State& state,
             ContactConstraint& constraint, std::span<SolverBody> solver_bodies) {
  PersistentContact* const record = state.record;
  const double compression = constraint.normal_impulse[0] + constraint.normal_impulse[1];
  double owed = law.restitution * compression;
  if (record != nullptr) {
    const RestitutionMemory& memory = record->restitution;
    owed = std::min(owed + memory.owed_impulse, memory.limit - memory.given_impulse);
    remember_compression(constraint, is_converged, *record);
  }
  if (owed <= 0) return false;
  double most[2], given[2];
  double still_owed = 0;
  const double owed_per_compression = compression > 0 ? owed / compression : 0;
  for (int end = 0; end < 2; ++end) {
    const double share = compression > 0 ? owed_per_compression * constraint.normal_impulse[end] : 0.5 * owed;
    most[end] = std::min(constraint.normal_impulse[end] + share, constraint.limit);
    given[end] = most[end] - constraint.normal_impulse[end];
    still_owed += share - given[end];
  }
  const WorkOfShare work = work_of(constraint, given, solver_bodies);
  const double share = work.largest_within(std::max(0.0, stored));
  if (share < 1) still_owed = 0;  // all stored energy is given back
  for (int end = 0; end < 2; ++end) {
    if (share < 1) most[end] = constraint.normal_impulse[end] + (given[end] *= share);
    constraint.least[end] = constraint.normal_impulse[end] = most[end];
  }
  state.restored_work = work.of(share);
  stored -= state.restored_work;
  apply_impulses(constraint, given[0], given[1], 0, solver_bodies);
  if (record != nullptr) {
    record->restitution.owed_impulse = still_owed;
    record->restitution.given_impulse += share < 1 ? given[0] + given[1] : owed - still_owed;
  }
  return given[0] > 0 || given[1] > 0;
}

int separate(Bodies& bodies, const std::vector<Contact>& contacts, const SeparationSettings& settings, double dt) {
  // Each contact moves its own bodies by its own share, one after the other. This is a relaxation, not a solution,
  // which is enough because this overlap is a few centimetres that may take a second to decay.
  int moved = 0;
  const double share = std::min(1.0, dt / settings.time);
  for (const Contact& c : contacts) {
    const double excess = c.depth - std::max(settings.slop, c.record != nullptr ? c.record->crushed_depth : 0.0);
    if (excess <= 0) continue;
    const Vector arm_a = c.middle() - bodies.position[c.a];
    const Vector arm_b = c.middle() - bodies.position[c.b];
    const Mobility a{bodies.inverse_mass[c.a], bodies.inverse_moment[c.a], arm_a};
    const Mobility b{bodies.inverse_mass[c.b], bodies.inverse_moment[c.b], arm_b};
    const double p = share * excess * effective_mass(a, b, c.normal);  // an impulse times a second [kg m]
    move_body(bodies, c.a, -p * a.inverse_mass * c.normal, -p * a.inverse_moment * cross(arm_a, c.normal));
    move_body(bodies, c.b, p * b.inverse_mass * c.normal, p * b.inverse_moment * cross(arm_b, c.normal));
    ++moved;
  }
  return moved;
}

}  // namespace polynya::dynamics
