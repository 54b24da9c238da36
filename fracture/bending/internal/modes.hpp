#pragma once

#include <vector>

#include <Eigen/Dense>

#include "fracture/bending/internal/plate.hpp"
#include "fracture/bending/solver_settings.hpp"

namespace polynya::fracture {

/// Distance from the tip, in inner radii, up to which top fibres are not evaluated [-], because the free inner edge of
/// the mesh disturbs them.
inline constexpr double kFirstTopRadius = 5;

/// Distance from the tip, in l, up to which bottom fibres are not evaluated [-]. The hoop stress under the load of the
/// tip grows without bound as the loaded patch shrinks; within a fraction of the thickness the bending stress of a
/// plate does not describe the ice.
inline constexpr double kFirstBottomRadius = 0.01;

/// Distance from the tip, in l, beyond which fibres are not evaluated [-]: there are only ripples.
inline constexpr double kLastRadius = 4;

/// A wedge of ice on its water, decomposed into independent oscillators: with x = Σ X_k q_k,
///   (m̂ A + F) ẍ + (B + A) x = load   becomes   μ_k q̈_k + q_k = X_kᵀ load,   X_jᵀ (B + A) X_k = δ_jk
/// with the matrices B of bending, A of area, and F of the water's added mass. μ_k = 1/ω_k²; a mode without mass has μ
/// = 0 and follows its load at once. Time is in t0 = √(l/g).
struct WedgeModes {
  PlateMesh mesh;
  Eigen::VectorXd inertia;         ///< μ ≥ 0, ascending
  Eigen::MatrixXd load_shapes;     ///< modal loads = leading columns · tip_load(mesh, ξ)
  std::vector<double> radii;       ///< points on the bisector where the top fibre is evaluated, ascending
  Eigen::MatrixXd radial_moment;   ///< top-fibre tension at those points per unit of each mode
  std::vector<double> hoop_radii;  ///< points on the bisector where the bottom fibre is evaluated, ascending
  Eigen::MatrixXd hoop_moment;     ///< bottom-fibre hoop tension at those points per unit of each mode
  Eigen::VectorXd tip;             ///< deflection of the tip per unit of each mode
};

/// Mass and stiffness of a wedge on its water. The unknowns are the unknowns of the plate and then, with
/// FluidModel::kFreeSurface, the elevations of the panels of open water.
struct WedgeMatrices {
  Eigen::MatrixXd mass;
  Eigen::MatrixXd stiffness;
};

/// Assembles the matrices. `mass_ratio` is m̂ = ρ_i h / (ρ_w l) > 0.
WedgeMatrices assemble_wedge(const PlateMesh& mesh, double mass_ratio, const SolverSettings& settings);

/// Returns the modes of a wedge. `half_angle` is α in (0, π] [rad], `mass_ratio` is m̂.
WedgeModes wedge_modes(double half_angle, double mass_ratio, const SolverSettings& settings);

/// Returns the modal amplitudes of the static solution for a unit load on the tip.
Eigen::VectorXd static_amplitudes(const WedgeModes& modes, double patch_radius);

}  // namespace polynya::fracture
