#pragma once

#include "fracture/bending/bending_model.hpp"
#include "fracture/bending/database.hpp"
#include "fracture/bending/wedge_solver.hpp"

namespace polynya::fracture {

/// A physical load as the dimensionless problem of the wedge solver, and the scales of its answer. With l =
/// (D / ρ_w g)^¼ and t0 = √(l/g):
///   2α = θ_wf + θ_wb, m̂ = ρ_i h / (ρ_w l), Fr = v_n / √(g l), Π = σ_f h² / (κ l²)
///   κ = σ_c c_V T / (2 sin θ_s), T = tan θ_wf + tan θ_wb: V = κ [ξ² − ⟨ξ − h tan θ_s⟩²], Eqs. (1), (2) of
///   [Sawamura2017]
/// Edges of unequal angles crush as they are, through T, and bend as the symmetric wedge of the same opening
/// 2α.
struct ScaledLoad {
  WedgeGroups groups;       ///< softness is infinite where the hull cannot press the ice down, c_V ≤ 0 or θ_s = 0
  double full_depth = 0;    ///< h tan θ_s / l
  double feedback = 0;      ///< χ = σ_f h² tan θ_s / (ρ_w g l³)
  double length_scale = 0;  ///< l [m]
  double force_scale = 0;   ///< σ_f h² [N]
  double time_scale = 0;    ///< t0 [s]
};

ScaledLoad scaled(const BendingLoad& load);

/// The load's push from first contact on; whether the ice's own deflection slows the penetration is the
/// caller's choice.
enum class Feedback { kIgnored, kCoupled };
WedgePush push_of(const ScaledLoad& load, Feedback feedback);

}  // namespace polynya::fracture
