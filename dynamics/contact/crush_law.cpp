#include "dynamics/contact/crush_law.hpp"

#include <cmath>

#include "dynamics/contact/paid_overlap.hpp"

namespace polynya::dynamics {
namespace {

/// Number of Newton steps on the branches of both ends before all pairs of branches are tried. More than three are
/// rarely needed. Fewer cost time, not accuracy.
constexpr int kMostTries = 8;

/// The two ends of one contact line, with their laws and their mobility.
class EndPair {
 public:
  EndPair(const std::array<CrushResponse, 2>& ends, const std::array<CrushKinks, 2>& kinks,
          const EndsMobility& mobility, const std::array<double, 2>& closing_speed)
      : ends_(ends), kinks_(kinks), mobility_(mobility), free_(closing_speed) {}

  std::array<double, 2> speeds(const std::array<double, 2>& impulse) const {
    return {free_[0] - mobility_.at[0] * impulse[0] - mobility_.between * impulse[1],
            free_[1] - mobility_.between * impulse[0] - mobility_.at[1] * impulse[1]};
  }
  /// Returns the branches nearest to the given impulses and the speeds that follow from them.
  ActiveBranches branches_near(const std::array<double, 2>& impulse) const {
    const auto speed = speeds(impulse);
    return {{branch_near(ends_[0], kinks_[0], speed[0], impulse[0], mobility_.at[0]),
             branch_near(ends_[1], kinks_[1], speed[1], impulse[1], mobility_.at[1])}};
  }
  std::array<double, 2> solve_on(const ActiveBranches& branches) const {
    const BranchLine p = line_of(ends_[0], kinks_[0].creep, branches.of[0]);
    const BranchLine q = line_of(ends_[1], kinks_[1].creep, branches.of[1]);
    const double right_0 = p.at_rest + p.slope * (free_[0] - ends_[0].gap_speed);
    const double right_1 = q.at_rest + q.slope * (free_[1] - ends_[1].gap_speed);
    const double m00 = 1 + p.slope * mobility_.at[0];
    const double m11 = 1 + q.slope * mobility_.at[1];
    const double m01 = p.slope * mobility_.between;
    const double m10 = q.slope * mobility_.between;
    const double determinant = m00 * m11 - m01 * m10;  // ≥ 1: K is positive semidefinite
    return {(m11 * right_0 - m01 * right_1) / determinant, (m00 * right_1 - m10 * right_0) / determinant};
  }
  /// Returns by how much impulses deviate from the law [N s].
  double violation(const std::array<double, 2>& impulse) const {
    const auto u = speeds(impulse);
    return std::max(std::abs(impulse[0] - crush_impulse(ends_[0], u[0])),
                    std::abs(impulse[1] - crush_impulse(ends_[1], u[1])));
  }
  std::array<double, 2> best_of_all() const {
    std::array<double, 2> best{};
    double least = violation(best);
    for (int i = 0; i < 4; ++i) {
      for (int j = 0; j < 4; ++j) {
        const auto impulse = solve_on({{static_cast<CrushBranch>(i), static_cast<CrushBranch>(j)}});
        if (const double missed = violation(impulse); missed < least) {
          least = missed;
          best = impulse;
        }
      }
    }
    return best;
  }

 private:
  const std::array<CrushResponse, 2>& ends_;
  const std::array<CrushKinks, 2>& kinks_;
  const EndsMobility& mobility_;
  std::array<double, 2> free_;
};

EndsLine line_on(const CrushLaw::State& c, const EndsMobility& mobility) {
  EndsLine line;
  const BranchLine p = line_of(c.ends[0], c.kinks[0].creep, c.branches.of[0]);
  const BranchLine q = line_of(c.ends[1], c.kinks[1].creep, c.branches.of[1]);
  const double m00 = 1 + p.slope * mobility.at[0], m11 = 1 + q.slope * mobility.at[1];
  const double m01 = p.slope * mobility.between, m10 = q.slope * mobility.between;
  const double inverse = 1 / (m00 * m11 - m01 * m10);
  line.at_rest[0] = (m11 * p.at_rest - m01 * q.at_rest) * inverse;
  line.at_rest[1] = (m00 * q.at_rest - m10 * p.at_rest) * inverse;
  line.by[0][0] = m11 * p.slope * inverse, line.by[0][1] = -m01 * q.slope * inverse;
  line.by[1][0] = -m10 * p.slope * inverse, line.by[1][1] = m00 * q.slope * inverse;
  for (std::size_t end = 0; end < 2; ++end) {
    const auto places = places_of(c.ends[end], c.kinks[end], mobility.at[end], c.branches.of[end]);
    line.after[end] = places[0], line.to[end] = places[1];
  }
  return line;
}

/// Returns what crush_impulses returns, but uses the line of the last solution if its branches still hold.
std::array<double, 2> impulses_of(CrushLaw::State& c, const EndsMobility& mobility,
                                  const std::array<double, 2>& closing_speed) {
  if (c.line) {
    const EndsLine& line = *c.line;
    const double x0 = closing_speed[0] - c.ends[0].gap_speed, x1 = closing_speed[1] - c.ends[1].gap_speed;
    const double p0 = line.at_rest[0] + line.by[0][0] * x0 + line.by[0][1] * x1;
    const double p1 = line.at_rest[1] + line.by[1][0] * x0 + line.by[1][1] * x1;
    const double place_0 = x0 - mobility.between * p1, place_1 = x1 - mobility.between * p0;
    if (place_0 > line.after[0] && place_0 <= line.to[0] && place_1 > line.after[1] && place_1 <= line.to[1])
      return {std::clamp(p0, 0.0, c.ends[0].cap), std::clamp(p1, 0.0, c.ends[1].cap)};
  }
  const auto impulse = crush_impulses(c.ends, c.kinks, mobility, closing_speed, c.branches);
  c.line = line_on(c, mobility);
  return impulse;
}

/// Returns v_g, the speed at which the gap to the paid depth is closed [m/s].
double gap_speed_of(const CrushLaw& law, const CrushLaw::State& c) {
  const double gap = c.paid - c.depth;
  if (gap >= 0) return gap * law.substeps / law.step;
  return c.is_new ? 0 : gap / std::max(kDecayTime, law.step);
}

double closing_speed_of(const ConstraintSpeeds& speeds) {
  return -0.5 * (speeds.apart[0] + speeds.apart[1]);
}

CrushingForce force_of(const CrushLaw::State& c) {
  return {c.force, c.exponent, std::max(c.depth, c.paid)};
}

/// Returns the stiffness k for bodies that close at their present speeds for a time τ, after the gap is closed [N/m].
double stiffness_in(const CrushLaw::State& c, const ConstraintSpeeds& speeds, double tau) {
  const double gap = std::max(0.0, c.paid - c.depth);
  return stiffness_over(force_of(c), std::max(0.0, tau * closing_speed_of(speeds) - gap));
}

/// Returns the largest impulse of the ice in a time τ before it breaks [N s]. If the force, growing at the present
/// closing speed, reaches the breaking force within τ, this is the impulse up to then.
double impulse_to_breaking(const CrushLaw::State& c, const ConstraintSpeeds& speeds, double tau) {
  if (!std::isfinite(c.breaking_force)) return c.breaking_force;
  const double growth = closing_speed_of(speeds) * stiffness_in(c, speeds, tau);  // [N/s]
  const double left = c.breaking_force - c.force;
  if (left <= 0) return 0;
  const double time = growth > 0 ? left / growth : tau;
  return time < tau ? 0.5 * (c.force + c.breaking_force) * time : tau * c.breaking_force;
}

}  // namespace

std::array<double, 2> places_of(const CrushResponse& law, const CrushKinks& kinks, double inverse_mass,
                                CrushBranch branch) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  const double creeping_to = kinks.creeping_to + inverse_mass * kinks.crept;
  const double crushing_to = kinks.crept == law.cap ? creeping_to
                             : law.slope == 0       ? kInfinity
                                                    : kinks.crushing_to + inverse_mass * law.cap;
  switch (branch) {
    case CrushBranch::kApart:
      return {-kInfinity, 0};
    case CrushBranch::kCreeping:
      return {0, creeping_to};
    case CrushBranch::kCrushing:
      return {creeping_to, crushing_to};
    case CrushBranch::kBroken:
      return {crushing_to, kInfinity};
  }
  return {};
}

std::array<double, 2> crush_impulses(const std::array<CrushResponse, 2>& ends, const std::array<CrushKinks, 2>& kinks,
                                     const EndsMobility& mobility, const std::array<double, 2>& closing_speed,
                                     ActiveBranches& branches) {
  if (closing_speed[0] <= ends[0].gap_speed && closing_speed[1] <= ends[1].gap_speed) {
    branches = {};
    return {0, 0};
  }
  const EndPair pair(ends, kinks, mobility, closing_speed);
  if (branches == ActiveBranches{}) branches = pair.branches_near({0, 0});
  for (std::size_t end = 0; end < 2; ++end) {
    const bool never_breaks = std::isinf(ends[end].cap);
    if (branches.of[end] == CrushBranch::kBroken && never_breaks) branches.of[end] = CrushBranch::kCrushing;
  }
  for (int i = 0; i < kMostTries; ++i) {
    const auto impulse = pair.solve_on(branches);
    const ActiveBranches next = pair.branches_near(impulse);
    if (next == branches) return {std::clamp(impulse[0], 0.0, ends[0].cap), std::clamp(impulse[1], 0.0, ends[1].cap)};
    branches = next;
  }
  const auto impulse = pair.best_of_all();
  return {std::clamp(impulse[0], 0.0, ends[0].cap), std::clamp(impulse[1], 0.0, ends[1].cap)};
}

CrushLaw::State state_of(const CrushLaw& /*law*/, const Contact& c) {
  const bool crushes = c.crushing_force > 0 && !c.is_rigid();
  const double exponent = crushes ? c.crushing_stiffness * std::max(c.depth, c.paid_depth) / c.crushing_force : 0;
  return {.force = c.crushing_force,
          .exponent = exponent,
          .depth = c.depth,
          .paid = c.paid_depth,
          .paying_work = 0,
          .missed = c.missed_impulse,
          .breaking_force = c.breaking_force,
          .most_force = c.most_force,
          .ends = {},
          .kinks = {},
          .branches = {},
          .line = {},
          .last_impulse = {c.record->last_impulse[0], c.record->last_impulse[1]},
          .last_slip = c.record->last_slip_impulse,
          .is_rigid = c.is_rigid(),
          .is_broken = false,
          .breaks_at_cap = false,
          .is_new = c.is_new};
}

void begin_substep(const CrushLaw& law, const ConstraintSpeeds& before, bool is_first, CrushLaw::State& state,
                   ContactConstraint& constraint) {
  if (state.is_rigid) return;
  const double tau = law.step / law.substeps;
  // The force at the present overlap, extrapolated with the slope of the law from where it was found.
  CrushResponse& end = state.ends[0];
  const double missed = is_first ? state.missed : 0;
  end.impulse_of_force = 0.5 * (tau * state.force + missed);
  end.slope = 0.25 * stiffness_in(state, before, tau) * tau * tau;
  end.gap_speed = gap_speed_of(law, state);
  end.creep_speed = creep_speed_of(end.gap_speed);
  const double to_breaking = state.is_broken ? 0 : impulse_to_breaking(state, before, tau);
  const double most = tau * state.most_force;
  state.breaks_at_cap = to_breaking <= most;
  end.cap = state.is_broken ? 0 : 0.5 * (std::min(to_breaking, most) + missed);
  state.ends[1] = end;
  state.kinks[0] = state.kinks[1] = kinks_of(end);
  state.line.reset();
  constraint.limit = end.cap;
}

double solve_block(const CrushLaw& /*law*/, CrushLaw::State& state, ContactConstraint& k,
                   std::span<SolverBody> solver_bodies) {
  if (state.is_rigid) return solve_constraint(k, solver_bodies);
  const SolverBody& a = solver_bodies[k.a];
  const SolverBody& b = solver_bodies[k.b];
  const EndsMobility mobility = mobility_of(k);
  const auto trial = trial_speeds(mobility, apart_at(k, a, b), k.normal_impulse);
  const double p0 = k.normal_impulse[0], p1 = k.normal_impulse[1];
  if (p0 == 0 && p1 == 0 && k.slip_impulse == 0 && trial[0] <= state.ends[0].gap_speed &&
      trial[1] <= state.ends[1].gap_speed)
    return 0;
  const auto impulse = impulses_of(state, mobility, trial);
  const double change_0 = impulse[0] - p0;
  const double change_1 = impulse[1] - p1;
  k.normal_impulse[0] = impulse[0];
  k.normal_impulse[1] = impulse[1];
  const double slip = slip_to_rest(k, a, b, change_0, change_1) - k.slip_impulse;
  k.slip_impulse += slip;
  apply_impulses(k, change_0, change_1, slip, solver_bodies);
  return std::max(
      {std::abs(change_0) * mobility.at[0], std::abs(change_1) * mobility.at[1], std::abs(slip) * k.inverse_slip_mass});
}

double missed_speed(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                    std::span<const SolverBody> solver_bodies) {
  ContactConstraint k = constraint;
  k.a = 0, k.b = 1;
  CrushLaw::State own = state;
  std::array<SolverBody, 2> both{solver_bodies[constraint.a], solver_bodies[constraint.b]};
  return solve_block(law, own, k, both);
}

void end_substep(const CrushLaw& law, const ConstraintSpeeds& before, const ConstraintSpeeds& after,
                 const ContactConstraint& constraint, CrushLaw::State& state) {
  double closing = 0;
  double work = -0.5 * constraint.slip_impulse * (before.slip + after.slip);  // slip wears ice off, too
  for (std::size_t end = 0; end < 2; ++end) {
    closing -= 0.5 * after.apart[end];  // the bodies are moved with their new speeds
    work -= 0.5 * constraint.normal_impulse[end] * (before.apart[end] + after.apart[end]);
    if (!state.is_rigid && state.breaks_at_cap && branch_at(state.ends[end], -after.apart[end]) == CrushBranch::kBroken)
      state.is_broken = true;
  }
  const CrushingForce force = force_of(state);
  state.depth = std::max(0.0, state.depth + law.step / law.substeps * closing);
  if (state.is_rigid) return;
  const Payment payment = pay(force, state.paid, state.depth, work);
  state.paid = payment.depth;
  state.paying_work += payment.work;
  state.force = std::min(state.most_force, force_at(force, std::max({force.depth, state.depth, state.paid})));
}

void write_back(const CrushLaw& law, const CrushLaw::State& state, const ContactConstraint& constraint,
                Contact& contact) {
  for (int end = 0; end < 2; ++end) contact.record->last_impulse[end] = constraint.normal_impulse[end];
  contact.record->last_slip_impulse = constraint.slip_impulse;
  contact.is_broken = state.is_broken;
  contact.is_at_limit = !state.is_rigid && contact.total_normal_impulse() > 0;  // all of it crushes
  contact.depth_after = state.depth;
  contact.paid_depth_after = state.paid;
  contact.paying_work = state.paying_work;
  const double of_step = law.step * contact.crushing_force;
  contact.step_share = state.missed > 0 ? of_step / (of_step + state.missed) : 1;
}

}  // namespace polynya::dynamics
