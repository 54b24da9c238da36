#include "fracture/bending/wedge_solver.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "fracture/bending/internal/modes.hpp"
#include "fracture/bending/peak.hpp"

namespace polynya::fracture {
namespace {

constexpr double kDeepest = 3;      ///< largest penetration that this solver can follow, in l
constexpr int kMostSteps = 100000;  ///< far more than a push to kDeepest needs

/// Moment at which the plate breaks, in σ_f h²: the stress is 6 M / h².
constexpr double kBreakingMoment = 1.0 / 6;

/// Moments on the bisector at one instant [σ_f h²].
struct BisectorState {
  Eigen::VectorXd radial;  ///< top-fibre radial tension
  Eigen::VectorXd hoop;    ///< bottom-fibre hoop tension
};

BisectorState bisector_state(const WedgeModes& modes, const Eigen::VectorXd& amplitudes) {
  return {modes.radial_moment * amplitudes, modes.hoop_moment * amplitudes};
}

/// Returns the largest top-fibre tension; at kBreakingMoment the cusp breaks off.
double peak_radial(const WedgeModes& modes, const BisectorState& state) {
  return find_peak(modes.radii, {state.radial.data(), modes.radii.size()}).value;
}

/// Returns the largest bottom-fibre hoop tension; at kBreakingMoment a crack opens along the bisector.
double peak_hoop(const WedgeModes& modes, const BisectorState& state) {
  return find_peak(modes.hoop_radii, {state.hoop.data(), modes.hoop_radii.size()}).value;
}

/// Returns the distance from the tip to the largest top-fibre tension, where the cusp breaks off. A fit is used because
/// that maximum is flat: 0.1 % of stress spans 10 % of radius.
double cusp_radius(const WedgeModes& modes, const BisectorState& state) {
  return find_flat_peak(modes.radii, {state.radial.data(), modes.radii.size()});
}

/// One step of μ q̈ + q = f with f linear from f0 to f1, solved exactly. With y = q − f and g = (f1 − f0) / Δ,
///   y(s) = y0 cos ωs + (q̇0 − g) / ω sin ωs
class ModalStep {
 public:
  ModalStep(const Eigen::VectorXd& inertia, double step) : step_(step) {
    period_ = inertia.array().sqrt();  // 1/ω
    cosine_.resize(inertia.size());
    sine_.resize(inertia.size());
    for (Eigen::Index k = 0; k < inertia.size(); ++k) {
      const bool has_mass = period_[k] > kMassless * step;
      cosine_[k] = has_mass ? std::cos(step / period_[k]) : 0;  // without mass q = f at once
      sine_[k] = has_mass ? std::sin(step / period_[k]) : 0;
      if (!has_mass) period_[k] = 0;
    }
  }

  /// Amplitudes and velocities / ω at the step's end.
  void advance(const Eigen::ArrayXd& load, const Eigen::ArrayXd& next_load, Eigen::ArrayXd& amplitude,
               Eigen::ArrayXd& velocity) const {
    const Eigen::ArrayXd drift = (next_load - load) / step_ * period_;
    const Eigen::ArrayXd y = amplitude - load, v = velocity - drift;
    amplitude = next_load + y * cosine_ + v * sine_;
    velocity = drift - y * sine_ + v * cosine_;
  }

 private:
  static constexpr double kMassless = 1e-9;  // of a period in steps: a faster mode follows its load at once
  double step_;
  Eigen::ArrayXd period_, cosine_, sine_;
};

struct MarchState {
  double time = 0, penetration = 0;
  Eigen::ArrayXd load, amplitude, velocity;
};

Eigen::ArrayXd modal_load(const WedgeModes& modes, const WedgePush& push, double penetration) {
  if (penetration <= 0) return Eigen::ArrayXd::Zero(modes.inertia.size());
  return push_force(push, penetration) * static_amplitudes(modes, penetration).array();
}

/// Returns the state after one time step. If coupled, bisection solves ξ + χ w_tip(ξ) = Fr τ, whose left side grows
/// with ξ.
MarchState next_state(const WedgeModes& modes, const WedgePush& push, const ModalStep& step, double time,
                      const MarchState& from) {
  const double free_depth = push.froude * time;
  const auto stepped_to = [&](double penetration) {
    MarchState next = from;
    next.time = time;
    next.penetration = std::max(penetration, from.penetration);
    next.load = modal_load(modes, push, next.penetration);
    step.advance(from.load, next.load, next.amplitude, next.velocity);
    return next;
  };
  if (push.feedback == 0) return stepped_to(free_depth);
  const auto excess = [&](double penetration) {
    const MarchState trial = stepped_to(penetration);
    return penetration + push.feedback * modes.tip.dot(trial.amplitude.matrix()) - free_depth;
  };
  double shallow = from.penetration, deep = std::max(free_depth, from.penetration);
  if (excess(shallow) >= 0) return stepped_to(shallow);  // the ice recedes faster than the hull advances
  while (deep - shallow > 1e-9 * deep) {
    const double middle = 0.5 * (shallow + deep);
    (excess(middle) < 0 ? shallow : deep) = middle;
  }
  return stepped_to(deep);
}

/// Returns the penetration at which a slow push breaks the wedge: the static peak moment reaches the strength.
std::optional<double> static_failure_depth(const WedgeModes& modes, const WedgePush& push) {
  const auto breaks = [&](double depth) {
    const BisectorState state = {modes.radial_moment * modal_load(modes, push, depth).matrix(), {}};
    return peak_radial(modes, state) >= kBreakingMoment;
  };
  double whole = modes.mesh.radii.front() * 1e-3, broken = whole;
  while (!breaks(broken)) {
    whole = broken;
    broken *= 2;
    if (broken > kDeepest) return std::nullopt;
  }
  while (broken - whole > 1e-3 * broken) {
    const double middle = 0.5 * (whole + broken);
    (breaks(middle) ? broken : whole) = middle;
  }
  return broken;
}

/// Returns the fraction of a step after which a peak that grows linearly from `before` to `after` reaches the strength.
double crossing(double before, double after) {
  return after > before ? std::clamp((kBreakingMoment - before) / (after - before), 0.0, 1.0) : 1.0;
}

/// One instant of a solution, with the state of the bisector.
struct Instant {
  MarchState state;
  BisectorState bisector;
};

/// Interpolates the state of the bisector linearly between two states.
BisectorState between(const BisectorState& a, const BisectorState& b, double share) {
  return {a.radial + share * (b.radial - a.radial), a.hoop + share * (b.hoop - a.hoop)};
}

/// Returns the break between two instants, by linear interpolation of the bisector's state.
WedgeFailure failure_between(const WedgeModes& modes, const WedgePush& push, const Instant& whole,
                             const Instant& broken) {
  const double s = crossing(peak_radial(modes, whole.bisector), peak_radial(modes, broken.bisector));
  const BisectorState at_break = between(whole.bisector, broken.bisector, s);
  WedgeFailure failure;
  failure.time = whole.state.time + s * (broken.state.time - whole.state.time);
  failure.penetration = whole.state.penetration + s * (broken.state.penetration - whole.state.penetration);
  failure.force = push_force(push, failure.penetration);
  failure.cusp_radius = cusp_radius(modes, at_break);
  failure.crack_ratio = peak_hoop(modes, at_break) / kBreakingMoment;
  return failure;
}

/// Takes steps of duration / steps until the wedge breaks, even if that takes longer than `duration`.
std::optional<WedgeFailure> march(const WedgeModes& modes, const WedgePush& push, double duration, int steps) {
  const ModalStep step(modes.inertia, duration / steps);
  const Eigen::ArrayXd rest = Eigen::ArrayXd::Zero(modes.inertia.size());
  Instant now{{0, 0, rest, rest, rest}, bisector_state(modes, rest.matrix())};
  double greatest_hoop = 0;
  for (int i = 1; i <= kMostSteps && now.state.penetration <= kDeepest; ++i) {
    Instant next;
    next.state = next_state(modes, push, step, duration * i / steps, now.state);
    next.bisector = bisector_state(modes, next.state.amplitude.matrix());
    const double hoop = peak_hoop(modes, next.bisector);
    if (peak_radial(modes, next.bisector) >= kBreakingMoment) {
      WedgeFailure failure = failure_between(modes, push, now, next);
      failure.crack_ratio = std::max(failure.crack_ratio, greatest_hoop / kBreakingMoment);
      return failure;
    }
    greatest_hoop = std::max(greatest_hoop, hoop);
    now = std::move(next);
  }
  return std::nullopt;
}

}  // namespace

double push_force(const WedgePush& push, double penetration) {
  const double beyond = push.full_depth > 0 ? std::max(0.0, penetration - push.full_depth) : 0;
  return (penetration * penetration - beyond * beyond) / push.softness;
}

double push_depth(const WedgePush& push, double force) {
  const double square = push.softness * force;
  const double full = push.full_depth;
  if (full <= 0 || square <= full * full) return std::sqrt(square);
  return 0.5 * (square / full + full);  // V̂ Π = ξ² − (ξ − ξ_full)² = 2 ξ ξ_full − ξ_full²
}

WedgeSolver::WedgeSolver(double opening_angle, double mass_ratio, const SolverSettings& settings)
    : settings_(settings),
      modes_(std::make_shared<const WedgeModes>(wedge_modes(0.5 * opening_angle, mass_ratio, settings))) {}

std::optional<WedgeFailure> WedgeSolver::failure(const WedgePush& push) const {
  const std::optional<double> depth = static_failure_depth(*modes_, push);
  if (!depth) return std::nullopt;
  return march(*modes_, push, *depth / push.froude, settings_.steps_to_failure);
}

}  // namespace polynya::fracture
