#pragma once

#include <array>
#include <memory>
#include <span>

#include "dynamics/contact/contact_constraint.hpp"
#include "dynamics/contact/crush_law.hpp"

namespace polynya::dynamics {

/// The law of steel on steel at one end: rigid, but for a speed of a millionth of the approach.
/// `inverse_mass`: of the end, K's diagonal [1/kg].
CrushResponse rigid_law(double inverse_mass);

/// What solving jams takes beside them. It keeps the shape of a jam's matrix for the next one between the same bodies;
/// what is found does not depend on it.
class JamMemory {
 public:
  JamMemory();
  ~JamMemory();
  JamMemory(JamMemory&&) noexcept;
  JamMemory& operator=(JamMemory&&) noexcept;
  struct Parts;
  Parts& parts() { return *parts_; }

 private:
  std::unique_ptr<Parts> parts_;
};

/// Finds the impulses of one jammed island by Newton's method, where sweeps over its contacts converge
/// slowly: the new velocities v minimise
///
///   ½ (v − v⁰)ᵀ M (v − v⁰) + Σ Φ_i(u_i(v)) + Σ Ψ_c(s_c(v)),   Φ_i' = λ_i,
///
/// strictly convex and piecewise quadratic (docs/theory/contact.md): v⁰ are the velocities without
/// impulses, M the masses, u_i the closing speed of an end, s_c the slip of a contact, λ their impulses by
/// the law. Each Newton step solves the equations of the branches at hand, a sparse system of 3 unknowns a
/// body. The active set of the next one are the branches of λ = λ(û − K λ), solved for each contact alone, û
/// = u + K λ its trial closing speeds and K its mobility (primal-dual active sets, [Hintermueller2003]).
/// After some steps half of the contacts wait in each, which ends cycles. Ψ is friction: the slip impulse
/// grows to its bound, μ times the normal impulses, within `slip_speed` [m/s] or less. The bound of what slips
/// follows within the step: the exact derivative of Coulomb's law, not symmetric [Alart1991]. Starts from the
/// constraints' impulses and the bodies' velocities.
///
/// Enters the impulses into the constraints and the velocities into the bodies and returns true where no
/// contact would leave its branches. Else returns false; what it came to is entered where that misses its speeds by
/// less than `residual`, that of the start [m/s], and sweeps go on from there; or both stay as they were. Bodies of
/// prescribed motion are never changed. The same by any number of threads.
bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
               double slip_speed, double residual, JamMemory& memory, int threads = 1);
inline bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws,
                      std::span<SolverBody> bodies, double slip_speed) {
  JamMemory memory;
  return solve_jam(constraints, laws, bodies, slip_speed, 0, memory);
}

}  // namespace polynya::dynamics
