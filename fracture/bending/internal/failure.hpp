#pragma once

#include "fracture/bending/internal/modes.hpp"

namespace polynya::fracture {

/// Stress is 6 M / h², so that a moment of σ_f h² / 6 breaks the plate: in σ_f h²,
inline constexpr double kBreakingMoment = 1.0 / 6;

/// Moments on the bisector at one moment of a march [σ_f h²].
struct BisectorState {
  Eigen::VectorXd radial;  ///< top-fibre radial tension
  Eigen::VectorXd hoop;    ///< bottom-fibre hoop tension
};

BisectorState bisector_state(const WedgeModes& modes, const Eigen::VectorXd& amplitudes);

/// Greatest of the moments: top-fibre tension breaks off the cusp, bottom-fibre hoop tension opens a
/// crack.
double peak_moment(const WedgeModes& modes, const Eigen::VectorXd& moments);

/// Distance from the tip to the greatest top-fibre tension: where the cusp breaks off. That maximum is flat,
/// 0.1 % of stress spans 10 % of radius, hence the fit.
double cusp_radius(const WedgeModes& modes, const Eigen::VectorXd& radial);

}  // namespace polynya::fracture
