#pragma once

#include <memory>
#include <optional>

#include "fracture/bending/solver_settings.hpp"

namespace polynya::fracture {

/// The push of a hull on a wedge in dimensionless form, with the penetration ξ in l and the time τ in t0:
///   ξ = Fr τ − χ w_tip,   V̂ = [ξ² − ⟨ξ − ξ_full⟩²] / Π
/// with V̂ = V / σ_f h². ξ never decreases: crushed ice stays crushed, and if the bending ice recedes from the hull,
/// the force stays constant.
struct WedgePush {
  double froude = 0;      ///< Fr = v_n / √(g l)
  double softness = 0;    ///< Π = σ_f h² / (κ l²): the inverse of the crushing force per depth²
  double full_depth = 0;  ///< ξ_full = h tan θ_s / l, at which the contact spans the thickness; 0: never
  double feedback = 0;    ///< χ = σ_f h² tan θ_s / (ρ_w g l³): recession of the ice from the hull; 0: ignored
};

/// The break of a wedge under a push.
struct WedgeFailure {
  double time = 0;         ///< τ_b
  double penetration = 0;  ///< ξ_b / l
  double force = 0;        ///< V̂_b
  double cusp_radius = 0;  ///< R / l
  double crack_ratio = 0;  ///< largest bottom-fibre hoop stress until τ_b, over σ_f: from 1 on a radial crack opens
};

/// Returns V̂ at a penetration ξ in l.
double push_force(const WedgePush& push, double penetration);

/// Returns the penetration at which the push has grown to a force: the inverse of push_force().
double push_depth(const WedgePush& push, double force);

struct WedgeModes;

/// One wedge of floating ice. It is decomposed into its modes once (tenths of a second), and then integrated under any
/// push (milliseconds), exactly for a load that is linear within each step. Safe to use from several threads.
class WedgeSolver {
 public:
  /// `opening_angle` is 2α in (0, 2π] [rad]; `mass_ratio` is m̂ = ρ_i h / (ρ_w l) > 0.
  WedgeSolver(double opening_angle, double mass_ratio, const SolverSettings& settings);

  /// Returns when and where the push breaks the wedge; nullopt if it does not within a penetration of 3 l.
  std::optional<WedgeFailure> failure(const WedgePush& push) const;

 private:
  SolverSettings settings_;
  std::shared_ptr<const WedgeModes> modes_;
};

}  // namespace polynya::fracture
