#pragma once

#include <array>
#include <span>

#include "dynamics/contact_constraint.hpp"
#include "dynamics/crush_law.hpp"

namespace polynya::dynamics {

/// Both ends' law of one contact.
using EndLaws = std::array<CrushResponse, 2>;

/// The law of steel on steel at one end: rigid, but for a speed of a millionth of the approach.
/// `inverse_mass`: of the end, K's diagonal [1/kg].
CrushResponse rigid_law(double inverse_mass);

/// Finds the impulses of one jammed island by Newton's method, where sweeps over its contacts converge
/// slowly: the new velocities v minimise
///
///   ½ (v − v⁰)ᵀ M (v − v⁰) + Σ Φ_i(u_i(v)) + Σ Ψ_c(s_c(v)),   Φ_i' = λ_i,
///
/// strictly convex and piecewise quadratic (docs/theory.md, "Contact"). Each step solves the quadratic of the
/// pieces at hand, a sparse symmetric positive definite system of 3 unknowns a body; the next pieces are
/// those nearest its speeds and impulses (primal-dual active sets, [Hintermueller2003]). Ψ is friction: the
/// slip impulse grows to its bound within `slip_speed` [m/s], and the bound, μ times the normal impulses,
/// follows from one step to the next. Starts from the constraints' impulses and the bodies' velocities.
///
/// Enters the impulses into the constraints and the velocities into the bodies and returns true where it came
/// to the minimum; else both stay as they were. Bodies of prescribed motion are never changed.
bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws,
               std::span<SolverBody> bodies, double slip_speed);

}  // namespace polynya::dynamics
