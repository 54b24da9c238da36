#pragma once

#include <array>
#include <memory>
#include <span>

#include "dynamics/contact/contact_constraint.hpp"
#include "dynamics/contact/crush_law.hpp"

namespace polynya::dynamics {

/// Returns the law of a steel-on-steel end. It is rigid, except for a speed of a millionth of the approach.
/// `inverse_mass` is the diagonal element of K for this end [1/kg].
CrushResponse rigid_law(double inverse_mass);

/// Memory that the solution of jams reuses: it keeps the structure of a jam's matrix for the next jam between the same
/// bodies. Results do not depend on it.
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

/// Finds the impulses of one jammed island by Newton's method. It is used where sweeps over the contacts converge
/// slowly. The new velocities v minimise
///
///   ½ (v − v⁰)ᵀ M (v − v⁰) + Σ Φ_i(u_i(v)) + Σ Ψ_c(s_c(v)),   Φ_i' = λ_i,
///
/// which is strictly convex and piecewise quadratic (docs/theory/solver.md). v⁰ are the velocities without impulses, M
/// the masses, u_i the closing speed of an end, s_c the slip of a contact, and λ_i their impulses by the law. Ψ is
/// friction: the slip impulse grows to its bound, μ times the normal impulses, within a slip of at most `slip_speed`
/// [m/s].
///
/// Each Newton step solves the equations of the present branches, a sparse system with 3 unknowns per body. The
/// branches (active set) of the next step follow from λ = λ(û − K λ), solved for each contact alone, where û = u + K λ
/// are its trial closing speeds and K is its mobility (primal-dual active sets, [Hintermueller2003]). After four steps
/// half of the changes are postponed in each step, which ends cycles; after 60 steps the method gives up. The bound of
/// a slipping contact follows within the step: this is the exact derivative of Coulomb's law, and it is not symmetric
/// [Alart1991]. After 16 steps it follows only by half. The method starts from the constraints' impulses and the
/// bodies' velocities.
///
/// Returns true if no contact would leave its branches, the friction bounds change no more, and the impulses give the
/// speeds for which they were computed to within `slip_speed`; impulses and velocities are then entered into the
/// constraints and the bodies. Otherwise it returns false. Its last result is then entered if it deviates from its
/// speeds by less than `residual` [m/s], the residual of the sweeps before, so that sweeps can continue from there; if
/// not, constraints and bodies keep their values. Bodies with prescribed motion are never changed. The result does not
/// depend on the number of threads.
bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws, std::span<SolverBody> bodies,
               double slip_speed, double residual, JamMemory& memory, int threads = 1);
/// Solves a jam without reused memory, and keeps the constraints and bodies if it is not solved. Used by tests.
inline bool solve_jam(std::span<ContactConstraint> constraints, std::span<const EndLaws> laws,
                      std::span<SolverBody> bodies, double slip_speed) {
  JamMemory memory;
  return solve_jam(constraints, laws, bodies, slip_speed, 0, memory);
}

}  // namespace polynya::dynamics
