#pragma once

#include <optional>

#include "fracture/bending/internal/modes.hpp"
#include "fracture/bending/wedge_solver.hpp"

namespace polynya::fracture {

/// Stress is 6 M / h², so that a moment of σ_f h² / 6 breaks the plate: in σ_f h²,
inline constexpr double kBreakingMoment = 1.0 / 6;

/// Moments on the bisector at one instant of a march [σ_f h²].
struct BisectorState {
  Eigen::VectorXd radial;  ///< top-fibre radial tension
  Eigen::VectorXd hoop;    ///< bottom-fibre hoop tension
};

BisectorState bisector_state(const WedgeModes& modes, const Eigen::VectorXd& amplitudes);

/// Greatest top-fibre tension: where it reaches kBreakingMoment the cusp breaks off.
double peak_radial(const WedgeModes& modes, const BisectorState& state);

/// Greatest bottom-fibre hoop tension: where it reaches kBreakingMoment a crack opens along the bisector.
double peak_hoop(const WedgeModes& modes, const BisectorState& state);

/// Distance from the tip to the greatest top-fibre tension: where the cusp breaks off. That maximum is flat,
/// 0.1 % of stress spans 10 % of radius, hence the fit.
double cusp_radius(const WedgeModes& modes, const BisectorState& state);

/// Marches the modes under the push until the top fibre's radial stress on the bisector reaches the flexural
/// strength. Exact for a load that is linear within each step; settings.steps_to_failure steps would bring a
/// slow push to failure. Nothing when the wedge does not break within the penetration this solver can follow,
/// ξ ≤ kDeepest.
std::optional<WedgeFailure> march_to_failure(const WedgeModes& modes, const WedgePush& push,
                                             const SolverSettings& settings);

inline constexpr double kDeepest = 3;  ///< in l

}  // namespace polynya::fracture
