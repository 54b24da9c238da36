#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <optional>

#include "dynamics/contact/contact_constraint.hpp"

namespace polynya::dynamics {

/// The least u_c: below it ice creeps instead of crushing with its full strength. It regularises the law; results are
/// alike from 1 to 20 mm/s. Far smaller, the creep branch is so steep that jams take more sweeps; greater, ice at rest
/// is driven into other ice.
inline constexpr double kCreepSpeed = 5e-3;  // [m/s]

/// The law of a contact in which ice crushes (docs/theory/contact.md): what crushing takes while the two close, nothing
/// while they part.
///
/// Over a time τ the bodies close by u⁺, their closing speed once all impulses have acted. The gap g is the depth to
/// which the overlap is paid (paid_overlap.hpp) less the depth of the overlap. A positive gap is closed first, without
/// a force. A negative gap is overlap whose ice is not gone: it is to be undone, or paid, within T, kDecayTime. What is
/// left, x = u⁺ − v_g, v_g = g/τ where g ≥ 0 and g/T where g < 0, crushes ice: the force there is F, growing by k x τ,
/// so that the impulse is
///
///   λ(x) = 0                       x ≤ 0
///          (τF/u_c + ½ k τ²) x     0 < x ≤ u_c
///          τF + ½ k τ² x           u_c < x
///
/// but never more than the impulse at which the ice breaks. The creep branch up to u_c makes λ continuous; it
/// never falls. So with K positive semidefinite the impulses of all contacts of a step, λ = λ(û − K λ), are
/// unique (docs/theory/solver.md): the solution of a strictly monotone problem, whatever the start.
/// Own law; crushing force by Eq. (2) of [Sawamura2017].
struct CrushResponse {
  double impulse_of_force = 0;       ///< τF of this end of the contact line, ≥ 0 [N s]
  double slope = 0;                  ///< ½ k τ², ≥ 0 [N s per m/s]
  double gap_speed = 0;              ///< v_g; negative: overlap that is not paid [m/s]
  double cap = 0;                    ///< most impulse, ≥ 0 [N s]
  double creep_speed = kCreepSpeed;  ///< u_c, > 0 [m/s]
};

/// T: overlap that is not paid is undone or paid in about this time, or in a step that is longer. Shorter: bodies are
/// thrown apart faster. Longer: overlap lasts for longer before its ice is paid.
inline constexpr double kDecayTime = 0.25;  // [s]

/// u_c by v_g: bodies that close by kCreepSpeed are pressed with all of F whatever is not paid; bodies at rest with a
/// part of it that grows with what is not paid, so that the force does not switch between nothing and all of F from
/// step to step where a jam is squeezed [m/s].
inline double creep_speed_of(double gap_speed) {
  return kCreepSpeed + std::max(0.0, -gap_speed);
}

/// A straight branch of the law: λ = at_rest + slope · (u − v_g).
struct BranchLine {
  double at_rest = 0;  ///< [N s]
  double slope = 0;    ///< [N s per m/s]
};
/// kBroken: the impulse is the most that there is, for the ice breaks or the whole length of the contact crushes.
enum class CrushBranch : std::uint8_t { kApart, kCreeping, kCrushing, kBroken };

inline double creep_slope(const CrushResponse& r) {
  return r.impulse_of_force / r.creep_speed + r.slope;
}

/// `creep` is creep_slope(r), for those that ask often.
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

/// Where a response has its kinks: found once, asked often.
struct CrushKinks {
  double creep = 0;        ///< creep_slope [N s per m/s]
  double crept = 0;        ///< the most that creeping gives [N s]
  double creeping_to = 0;  ///< x there [m/s]
  double crushing_to = 0;  ///< x where crushing comes to the cap; infinite where it never does [m/s]
};
inline CrushKinks kinks_of(const CrushResponse& r) {
  CrushKinks kinks;
  kinks.creep = creep_slope(r);
  kinks.crept = std::min(kinks.creep * r.creep_speed, r.cap);
  kinks.creeping_to = kinks.creep > 0 ? kinks.crept / kinks.creep : 0;
  kinks.crushing_to = r.slope == 0 ? std::numeric_limits<double>::infinity() : (r.cap - r.impulse_of_force) / r.slope;
  return kinks;
}

/// The branch whose point (closing speed, impulse) is nearest one that need not obey the law, along
/// (1, −1/inverse_mass), the line on which impulses change the speed of a mass. Far steadier than the branch
/// at the speed alone, which jumps across the steep one that creeps. `inverse_mass`: > 0 [1/kg].
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

/// λ of one end [N s].
inline double crush_impulse(const CrushResponse& r, double closing_speed) {
  const double creep = creep_slope(r);
  const BranchLine line = line_of(r, creep, branch_at(r, creep, closing_speed));
  return line.at_rest + line.slope * (closing_speed - r.gap_speed);
}

/// The branches that the two ends of a contact line are on.
struct ActiveBranches {
  CrushBranch of[2] = {CrushBranch::kApart, CrushBranch::kApart};
  friend bool operator==(const ActiveBranches&, const ActiveBranches&) = default;
};

/// How the impulses at the two ends of a contact line slow their closing: u = û − K λ, K symmetric, positive
/// semidefinite [1/kg].
struct EndsMobility {
  double at[2];
  double between;
};
inline EndsMobility mobility_of(const ContactConstraint& c) {
  return {{c.inverse_mass_at[0], c.inverse_mass_at[1]}, c.inverse_mass_between};
}
/// û = u + K λ: the closing speeds without a contact's own impulses, by its separating speeds [m/s].
inline std::array<double, 2> trial_speeds(const EndsMobility& k, const std::array<double, 2>& apart,
                                          const double* impulse) {
  return {-apart[0] + k.at[0] * impulse[0] + k.between * impulse[1],
          -apart[1] + k.between * impulse[0] + k.at[1] * impulse[1]};
}

/// After which place a branch begins, and to which one it is the nearest (branch_near) [m/s].
std::array<double, 2> places_of(const CrushResponse& law, const CrushKinks& kinks, double inverse_mass,
                                CrushBranch branch);

/// The impulses of both ends that obey the law together: λ_i = λ_i(û_i − (K λ)_i), û the closing speeds
/// without them [m/s]. On each pair of branches this is a 2 × 2 system, (I + diag(β) K) λ = α + β (û − v_g);
/// the branches follow from its solution, as in Newton's method, and where that goes round in circles, all
/// pairs are tried. Starts from `branches`, or from those of û where both are apart, and leaves there those
/// of the solution: the next one is likely on the same.
std::array<double, 2> crush_impulses(const std::array<CrushResponse, 2>& ends, const std::array<CrushKinks, 2>& kinks,
                                     const EndsMobility& mobility, const std::array<double, 2>& closing_speed,
                                     ActiveBranches& branches);

/// The impulses of both ends on one pair of branches, λ = at_rest + by (û − v_g), and between which places
/// (branch_near) that holds: solved once, asked in each sweep.
struct EndsLine {
  double at_rest[2];       ///< [N s]
  double by[2][2];         ///< [N s per m/s]
  double after[2], to[2];  ///< [m/s]
};

/// Both ends' law of one contact.
using EndLaws = std::array<CrushResponse, 2>;

/// The response law of crushing ice, over the substeps of a step (contact_solver.hpp). Contacts that do not
/// crush (Contact::is_rigid) end the approach of their bodies.
struct CrushLaw {
  double step = 0;              ///< Δt [s]
  int substeps = 1;             ///< equal parts of the step, solved one after the other on the step's geometry
  bool is_warm_started = true;  ///< from the impulses of the step before
  static constexpr bool kHasJams = true, kRestores = false;

  /// Of one contact, through the substeps.
  struct State {
    double force, exponent;  ///< F at the greater of depth and paid, both ends together [N]; n of F ∝ ξ^n [-]
    double depth, paid;      ///< of the overlap now, and to which it is paid [m]
    double paying_work;      ///< so far in the step [J]
    double missed;           ///< impulse before the contact was found [N s]
    double breaking_force;   ///< [N]
    double most_force;       ///< that the ice bears without breaking [N]
    EndLaws ends;            ///< of the substep
    std::array<CrushKinks, 2> kinks;
    ActiveBranches branches;       ///< of the ends, at the last solution
    std::optional<EndsLine> line;  ///< of these branches, once it is solved in this substep
    double last_impulse[2];        ///< where the step starts [N s]
    double last_slip;              ///< [N s]
    bool is_rigid, is_broken;
    bool breaks_at_cap;  ///< the most impulse is that at which the ice breaks, not what it bears as it crushes
    bool is_new;         ///< the missed impulse stands for the overlap that is not paid
  };
};

constexpr int substeps_of(const CrushLaw& law) {
  return law.substeps;
}
CrushLaw::State state_of(const CrushLaw& law, const Contact& contact);
void begin_substep(const CrushLaw& law, const ConstraintSpeeds& before, bool is_first, CrushLaw::State& state,
                   ContactConstraint& constraint);
/// λ of one end where the substep's sweeps start [N s].
inline double start_impulse(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                            int end, bool is_first) {
  if (!is_first) return constraint.normal_impulse[end];
  return law.is_warm_started ? state.last_impulse[end] : 0;
}
/// λ_t where the substep's sweeps start [N s].
inline double start_slip(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                         bool is_first) {
  if (!is_first) return constraint.slip_impulse;
  return law.is_warm_started ? state.last_slip : 0;
}
/// The impulses of both ends by the law, then the slip impulse within the Coulomb cone. Returns the largest
/// change of a speed at the contact [m/s].
double solve_block(const CrushLaw& law, CrushLaw::State& state, ContactConstraint& constraint,
                   std::span<SolverBody> solver_bodies);
/// By how much a contact misses the law at the speeds now: the change that solve_block would make [m/s].
double missed_speed(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                    std::span<const SolverBody> solver_bodies);
void end_substep(const CrushLaw& law, const ConstraintSpeeds& before, const ConstraintSpeeds& after,
                 const ContactConstraint& constraint, CrushLaw::State& state);
/// Writes what the step leaves into the contact, whose impulses are found, and its record. The constraint has
/// those of the last substep.
void write_back(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                Contact& contact);

}  // namespace polynya::dynamics
