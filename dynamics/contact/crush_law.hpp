#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "dynamics/contact/contact_constraint.hpp"

namespace polynya::dynamics {

/// Smallest creep speed u_c [m/s]. Below it ice creeps instead of crushing with its full strength, which regularises
/// the law. Results are similar from 1 to 20 mm/s. Far smaller: the creep branch is so steep that jams take more
/// sweeps. Larger: ice at rest is pushed into other ice.
inline constexpr double kCreepSpeed = 5e-3;  // [m/s]

/// The law of a contact at which ice crushes (docs/theory/contact.md): the crushing force acts while the two bodies
/// close, and no force acts while they separate.
///
/// Over a time τ, the length of a substep, the bodies close with u⁺, their closing speed after all impulses have acted.
/// The gap g is the paid depth of the overlap (paid_overlap.hpp) minus the depth of the overlap. A positive gap is
/// closed first, without a force. A negative gap is overlap whose ice is not gone; it has to be pushed apart, or paid,
/// within the time T, kDecayTime or the whole step if that is longer. The rest of the closing speed, x = u⁺ − v_g with
/// v_g = g/τ if g ≥ 0 and g/T if g < 0, crushes ice. The force is F and grows with the stiffness k, so that the impulse
/// is
///
///   λ(x) = 0                       x ≤ 0
///          (τF/u_c + ½ k τ²) x     0 < x ≤ u_c
///          τF + ½ k τ² x           u_c < x
///
/// but never more than the cap, the smaller of two impulses: the one at which the ice breaks, and the largest one that
/// the ice along the contact carries while it crushes. The creep branch up to u_c makes λ continuous; λ never
/// decreases. With a positive semidefinite K the impulses of all contacts of a step, λ = λ(û − K λ), are therefore
/// unique (docs/theory/solver.md): they solve a strictly monotone problem, whatever the start. Own law; crushing force
/// by Eq. (2) of [Sawamura2017]. This struct is the law of one end of a contact line, with half of F, k and cap.
struct CrushResponse {
  double impulse_of_force = 0;       ///< τF of this end of the contact line, ≥ 0 [N s]
  double slope = 0;                  ///< ½ k τ² of this end, ≥ 0 [N s per m/s]
  double gap_speed = 0;              ///< v_g; negative: overlap that is not paid [m/s]
  double cap = 0;                    ///< largest impulse of this end, ≥ 0 [N s]
  double creep_speed = kCreepSpeed;  ///< u_c, > 0 [m/s]
};

/// T: time in which overlap that is not paid is pushed apart or paid, unless a step is longer [s]. Shorter: bodies are
/// pushed apart faster. Longer: overlap lasts longer before its ice is paid.
inline constexpr double kDecayTime = 0.25;

/// Returns u_c for a gap speed v_g [m/s]. Bodies that close with kCreepSpeed press with all of F, whatever part of the
/// overlap is not paid. Bodies at rest press with a fraction of F that grows with the unpaid overlap. Without this the
/// force would switch between zero and F from step to step where a jam is squeezed.
inline double creep_speed_of(double gap_speed) {
  return kCreepSpeed + std::max(0.0, -gap_speed);
}

/// A straight branch of the law: λ = at_rest + slope · (u − v_g).
struct BranchLine {
  double at_rest = 0;  ///< [N s]
  double slope = 0;    ///< [N s per m/s]
};
/// Branches of the law. kBroken: the impulse is at its cap, because the ice breaks or the whole length of the contact
/// crushes.
enum class CrushBranch : std::uint8_t { kApart, kCreeping, kCrushing, kBroken };

inline double creep_slope(const CrushResponse& r) {
  return r.impulse_of_force / r.creep_speed + r.slope;
}

/// Returns the branch at a closing speed. `creep` is creep_slope(r), for callers that need it often.
inline CrushBranch branch_at(const CrushResponse& r, double creep, double closing_speed) {
  const double x = closing_speed - r.gap_speed;
  if (x <= 0) return CrushBranch::kApart;
  const double crept = creep * x;
  const double crushed = r.impulse_of_force + r.slope * x;
  if (std::min(crept, crushed) >= r.cap) return CrushBranch::kBroken;
  return crept < crushed ? CrushBranch::kCreeping : CrushBranch::kCrushing;
}

inline CrushBranch branch_at(const CrushResponse& r, double closing_speed) {
  return branch_at(r, creep_slope(r), closing_speed);
}

/// The kinks of a response, found once for many queries.
struct CrushKinks {
  double creep = 0;        ///< creep_slope [N s per m/s]
  double crept = 0;        ///< largest impulse of the creep branch [N s]
  double creeping_to = 0;  ///< x at the end of the creep branch [m/s]
  double crushing_to = 0;  ///< x at which crushing reaches the cap; infinite if it never does [m/s]
};
inline CrushKinks kinks_of(const CrushResponse& r) {
  CrushKinks kinks;
  kinks.creep = creep_slope(r);
  kinks.crept = std::min(kinks.creep * r.creep_speed, r.cap);
  kinks.creeping_to = kinks.creep > 0 ? kinks.crept / kinks.creep : 0;
  kinks.crushing_to = r.slope == 0 ? std::numeric_limits<double>::infinity() : (r.cap - r.impulse_of_force) / r.slope;
  return kinks;
}

/// Returns the branch that contains the point of the law nearest to a given point (closing speed, impulse), along the
/// line (1, −1/inverse_mass) on which impulses change the speed of a mass. The given point need not be on the law. This
/// is far steadier than the branch at the speed alone, which jumps across the steep creep branch. `inverse_mass` is > 0
/// [1/kg].
inline CrushBranch branch_near(const CrushResponse& r, const CrushKinks& kinks, double closing_speed, double impulse,
                               double inverse_mass) {
  const double place = closing_speed - r.gap_speed + inverse_mass * impulse;
  if (place <= 0) return CrushBranch::kApart;
  if (place <= kinks.creeping_to + inverse_mass * kinks.crept) return CrushBranch::kCreeping;
  if (kinks.crept == r.cap) return CrushBranch::kBroken;
  if (r.slope == 0) return CrushBranch::kCrushing;
  return place <= kinks.crushing_to + inverse_mass * r.cap ? CrushBranch::kCrushing : CrushBranch::kBroken;
}

inline BranchLine line_of(const CrushResponse& r, double creep, CrushBranch branch) {
  switch (branch) {
    case CrushBranch::kApart:
      return {0, 0};
    case CrushBranch::kCreeping:
      return {0, creep};
    case CrushBranch::kCrushing:
      return {r.impulse_of_force, r.slope};
    case CrushBranch::kBroken:
      return {r.cap, 0};
  }
  return {};
}

inline BranchLine line_of(const CrushResponse& r, CrushBranch branch) {
  return line_of(r, creep_slope(r), branch);
}

/// Returns λ of one end [N s].
inline double crush_impulse(const CrushResponse& r, double closing_speed) {
  const double creep = creep_slope(r);
  const BranchLine line = line_of(r, creep, branch_at(r, creep, closing_speed));
  return line.at_rest + line.slope * (closing_speed - r.gap_speed);
}

/// The branches of the two ends of a contact line.
struct ActiveBranches {
  CrushBranch of[2] = {CrushBranch::kApart, CrushBranch::kApart};
  friend bool operator==(const ActiveBranches&, const ActiveBranches&) = default;
};

/// Mobility K of a contact line: impulses λ at its two ends reduce their closing speeds, u = û − K λ. K is symmetric
/// and positive semidefinite [1/kg].
struct EndsMobility {
  double at[2];
  double between;
};
inline EndsMobility mobility_of(const ContactConstraint& c) {
  return {{c.inverse_mass_at[0], c.inverse_mass_at[1]}, c.inverse_mass_between};
}
/// Returns û = u + K λ, the closing speeds without the contact's own impulses, from its separating speeds `apart`
/// [m/s].
inline std::array<double, 2> trial_speeds(const EndsMobility& k, const std::array<double, 2>& apart,
                                          const double* impulse) {
  return {-apart[0] + k.at[0] * impulse[0] + k.between * impulse[1],
          -apart[1] + k.between * impulse[0] + k.at[1] * impulse[1]};
}

/// Returns the first and the last place (see branch_near) at which a branch is the nearest one [m/s].
std::array<double, 2> places_of(const CrushResponse& law, const CrushKinks& kinks, double inverse_mass,
                                CrushBranch branch);

/// Returns the impulses of both ends that obey the law together: λ_i = λ_i(û_i − (K λ)_i), where û are the closing
/// speeds without them [m/s]. On each pair of branches this is a 2 × 2 system, (I + diag(β) K) λ = α + β (û − v_g). The
/// branches follow from its solution, as in Newton's method; if this cycles, all pairs of branches are tried.
/// `branches` is the start (if both ends are apart, the branches at û are), and receives the branches of the solution,
/// on which the next solution probably lies as well.
std::array<double, 2> crush_impulses(const std::array<CrushResponse, 2>& ends, const std::array<CrushKinks, 2>& kinks,
                                     const EndsMobility& mobility, const std::array<double, 2>& closing_speed,
                                     ActiveBranches& branches);

/// The impulses of both ends on one pair of branches, λ = at_rest + by (û − v_g), and the places (see branch_near)
/// between which they hold. It is solved once and used in each sweep.
struct EndsLine {
  double at_rest[2];       ///< [N s]
  double by[2][2];         ///< [N s per m/s]
  double after[2], to[2];  ///< [m/s]
};

/// The laws of both ends of one contact.
using EndLaws = std::array<CrushResponse, 2>;

/// The response law of crushing ice, over the substeps of a step (contact_solver.hpp). A contact that does not crush
/// (Contact::is_rigid) ends the approach of its bodies.
struct CrushLaw {
  double step = 0;              ///< Δt [s]
  int substeps = 1;             ///< equal parts of the step, solved one after the other on the step's geometry
  bool is_warm_started = true;  ///< the solver starts from the impulses of the step before
  static constexpr bool kHasJams = true, kRestores = false;

  /// State of one contact, kept over the substeps.
  struct State {
    double force, exponent;  ///< F at the larger of depth and paid depth, both ends together [N]; n of F ∝ ξ^n [-]
    double depth, paid;      ///< present depth of the overlap, and its paid depth [m]
    double paying_work;      ///< work that has paid so far in the step [J]
    double missed;           ///< impulse missed before the contact was found [N s]
    double breaking_force;   ///< force at which the ice breaks; infinite if it does not [N]
    double most_force;       ///< largest force of crushing ice along the contact, however deep it becomes [N]
    EndLaws ends;            ///< laws of the ends in this substep
    std::array<CrushKinks, 2> kinks;
    ActiveBranches branches;       ///< branches of the ends, at the last solution
    std::optional<EndsLine> line;  ///< line of these branches, once solved in this substep
    double last_impulse[2];        ///< impulses from which the step starts [N s]
    double last_slip;              ///< [N s]
    bool is_rigid, is_broken;
    bool breaks_at_cap;  ///< the cap is the impulse at which the ice breaks, not the one that it carries as it crushes
    /// True if the overlap was found in this step for the first time. Then a negative gap counts as 0 (v_g = 0), and
    /// `missed` is added to the impulse instead.
    bool is_new;
  };
};

constexpr int substeps_of(const CrushLaw& law) {
  return law.substeps;
}
CrushLaw::State state_of(const CrushLaw& law, const Contact& contact);
/// Sets the laws of both ends for a substep, from the force at the present overlap and the speeds before.
void begin_substep(const CrushLaw& law, const ConstraintSpeeds& before, bool is_first, CrushLaw::State& state,
                   ContactConstraint& constraint);
/// Returns the λ of one end from which the sweeps of a substep start [N s].
inline double start_impulse(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                            int end, bool is_first) {
  if (!is_first) return constraint.normal_impulse[end];
  return law.is_warm_started ? state.last_impulse[end] : 0;
}
/// Returns the λ_t from which the sweeps of a substep start [N s].
inline double start_slip(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                         bool is_first) {
  if (!is_first) return constraint.slip_impulse;
  return law.is_warm_started ? state.last_slip : 0;
}
/// Solves the impulses of both ends by the law, then the slip impulse within the Coulomb cone. Returns the largest
/// change of a speed at the contact [m/s].
double solve_block(const CrushLaw& law, CrushLaw::State& state, ContactConstraint& constraint,
                   std::span<SolverBody> solver_bodies);
/// Returns by how much a contact deviates from the law at the present speeds: the change that solve_block would make
/// [m/s].
double missed_speed(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                    std::span<const SolverBody> solver_bodies);
/// Moves the depth by the new speeds, pays overlap by the work of the substep, and notes whether the ice broke.
void end_substep(const CrushLaw& law, const ConstraintSpeeds& before, const ConstraintSpeeds& after,
                 const ContactConstraint& constraint, CrushLaw::State& state);
/// Writes the results of the step into the contact, whose impulses are known, and into its record. The constraint has
/// the impulses of the last substep.
void write_back(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                Contact& contact);

}  // namespace polynya::dynamics
