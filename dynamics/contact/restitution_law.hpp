#pragma once

#include "dynamics/contact/contact_constraint.hpp"

namespace polynya::dynamics {

/// A body at a contact point, as in Eq. (5). Inverse mass and moment are 0 for prescribed motion.
struct Mobility {
  double inverse_mass = 0;    ///< [1/kg]
  double inverse_moment = 0;  ///< [1/(kg m²)]
  geometry::Vector arm;       ///< from the centre of mass to the contact point [m]
};

/// Returns 1 / [1/m_i + 1/m_k + (r_i × n)²/I_i + (r_k × n)²/I_k], the effective mass for an impulse along n at the
/// contact [kg]. Eq. (5) of [Sawamura2017]. Deviation: the paper prints r_i in the term of body k and r_k in the term
/// of body i, which gains energy.
inline double effective_mass(const Mobility& i, const Mobility& k, geometry::Vector direction) {
  const double arm_cross_i = cross(i.arm, direction);
  const double arm_cross_k = cross(k.arm, direction);
  return 1 / (i.inverse_mass + k.inverse_mass + arm_cross_i * arm_cross_i * i.inverse_moment +
              arm_cross_k * arm_cross_k * k.inverse_moment);
}

/// Returns j = (1 + ε) v_n m_eff for an approach speed v_n > 0 [m/s], and 0 otherwise [N s]. Eq. (5) of [Sawamura2017].
inline double collision_impulse(double approach_speed, double restitution, double effective_mass) {
  return approach_speed > 0 ? (1 + restitution) * approach_speed * effective_mass : 0;
}

/// The paper's response law (contact_solver.hpp), Eq. (5), corrected at each end of a contact line. Normal impulses are
/// limited to [0, limit/2], where limit = F Δt is the impulse of crushing ice in the step. It has three stages:
///   1. Compression: impulses that end every approach. They start from a prediction by the last two steps (a steady
///      push continues, a blow does not).
///   2. Restitution, as Poisson's share of the compression: ε times the impulse that compressed the contact. A contact
///      that is not limited separates with v⁺ = −ε v⁻ in one step, as Eq. (5) states. A contact that crushes takes as
///      many steps as the ice needs. Restitution never exceeds twice ε times the impulse that would end the fastest
///      approach so far of the two bodies alone, so that pressure from elsewhere does not charge it; twice, because
///      sliding friction makes that impulse larger. It never gives more energy than compression took from the bodies
///      of the island: over several steps the bodies turn, and the same impulse with other lever arms does different
///      work.
///   3. Compression again, of contacts that restitution pushed together.
struct RestitutionLaw {
  double restitution = 0.1;                                  ///< ε of Eq. (5) [-]
  double step = 1;                                           ///< Δt [s]
  static constexpr bool kHasJams = false, kRestores = true;  ///< no Newton's method; restitution after compression

  struct State {
    PersistentContact* record;  ///< null: no data are kept from step to step
    double crushing_impulse;    ///< F Δt; infinite if the contact does not crush [N s]
    double stored_energy;       ///< energy that restitution may give back [J]
    double taken_energy = 0;    ///< energy taken by the compression of this step; 0 if it gave energy [J]
    double restored_work = 0;   ///< energy that it has given back in this step [J]
  };
};

/// One substep: Poisson's share refers to the compression of a whole step.
constexpr int substeps_of(const RestitutionLaw& /*law*/) {
  return 1;
}
inline RestitutionLaw::State state_of(const RestitutionLaw& law, const Contact& contact) {
  PersistentContact* const record = contact.record;
  return {record, contact.crushing_force * law.step, record != nullptr ? record->stored_energy : 0};
}
/// Sets the largest impulse of each end, and raises the limit of restitution if the bodies approach faster than so far.
void begin_substep(const RestitutionLaw& law, const ConstraintSpeeds& before, bool is_first,
                   RestitutionLaw::State& state, ContactConstraint& constraint);
/// Returns the impulse of an end from which compression starts, predicted by the steps before [N s].
inline double start_impulse(const RestitutionLaw& /*law*/, const RestitutionLaw::State& state,
                            const ContactConstraint& /*constraint*/, int end, bool /*is_first*/) {
  return state.record != nullptr ? state.record->restitution.start_impulse[end] : 0;
}
/// Returns the slip impulse from which a substep starts [N s]. It is 0 in the first one; a later one starts from
/// the impulse at the end of the last one.
inline double start_slip(const RestitutionLaw& /*law*/, const RestitutionLaw::State& /*state*/,
                         const ContactConstraint& constraint, bool is_first) {
  return is_first ? 0 : constraint.slip_impulse;
}
/// Solves the contact alone, within its bounds. Returns the largest change of a speed at the contact [m/s].
inline double solve_block(const RestitutionLaw& /*law*/, RestitutionLaw::State& /*state*/,
                          ContactConstraint& constraint, std::span<SolverBody> solver_bodies) {
  return solve_constraint(constraint, solver_bodies);
}
/// Returns the energy that the impulses of a contact have taken from its bodies, from the speeds before and after them
/// [J].
double energy_taken(const ConstraintSpeeds& before, const ConstraintSpeeds& after, const ContactConstraint& constraint);
/// Gives back the impulses that a compression owes, as far as `stored` lasts, the energy that the contacts of its
/// island store [J]; the energy given back is subtracted from it. If `is_converged` is false, the next step starts
/// from half of the predicted impulses. Returns true if any impulse was given; compression then follows again.
bool restore(const RestitutionLaw& law, bool is_converged, double& stored, RestitutionLaw::State& state,
             ContactConstraint& constraint, std::span<SolverBody> solver_bodies);
inline void end_substep(const RestitutionLaw& /*law*/, const ConstraintSpeeds& /*before*/,
                        const ConstraintSpeeds& /*after*/, const ContactConstraint& /*constraint*/,
                        RestitutionLaw::State& /*state*/) {}
/// Enters the outcome of the step into the contact and its record. A contact is at its limit if its impulse reaches
/// F Δt up to rounding.
inline void write_back(const RestitutionLaw& /*law*/, const RestitutionLaw::State& state,
                       const ContactConstraint& /*constraint*/, Contact& contact) {
  contact.is_at_limit = contact.total_normal_impulse() >= state.crushing_impulse * (1 - 1e-9);
  contact.restored_work = state.restored_work;
  if (state.record != nullptr) state.record->stored_energy = state.stored_energy;
}

/// Settings of separate().
struct SeparationSettings {
  double time = 1.0;   ///< decay time of overlap that crushing did not make; longer: bodies move apart more slowly [s]
  double slop = 1e-4;  ///< depth up to which overlap is left; larger: more of it stays [m]
};

/// Separates overlapping bodies without giving them speed (split impulse). The overlap beyond what crushing made decays
/// within the settings' time; bodies move along the normals, in proportion to their inverse masses. Returns the number
/// of contacts that it moved.
int separate(Bodies& bodies, const std::vector<Contact>& contacts, const SeparationSettings& settings, double dt);

}  // namespace polynya::dynamics
