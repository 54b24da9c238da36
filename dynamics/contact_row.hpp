#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "dynamics/contact.hpp"

namespace polynya::dynamics {

/// A body's velocity while it is being solved for.
struct SolverBody {
  geometry::Vector velocity;  ///< of the centre of mass [m/s]
  double angular_velocity;    ///< [rad/s]
  double inverse_mass;        ///< 0: held [1/kg]
  double inverse_moment;      ///< 0: held [1/(kg m²)]
};

/// One contact line as its two bodies feel it, with the impulses found so far; [0] and [1] are its ends.
struct ContactConstraint {
  std::int32_t a, b;  ///< solver_bodies
  geometry::Vector normal;
  double arm_cross_normal_a[2], arm_cross_normal_b[2];  ///< arm × normal [m]
  double arm_cross_tangent_a,
      arm_cross_tangent_b;              ///< arm × perpendicular(normal), the same at both ends [m]
  double inverse_mass_at[2];            ///< velocity per impulse, at each end by its own [1/kg]
  double inverse_mass_between;          ///< at one end by the other's [1/kg]
  double inverse_determinant;           ///< 1 / determinant of the two; 0 where they do not differ [kg²]
  double inverse_slip_mass, slip_mass;  ///< velocity along the line per impulse [1/kg], and its inverse
  double least[2];                      ///< of the normal impulse: what restitution gave [N s]
  double limit;                         ///< of the normal impulse at each end [N s]
  double friction;                      ///< most slip impulse per normal impulse [-]
  double normal_impulse[2];             ///< [N s]
  double slip_impulse;                  ///< [N s]
};

/// Velocity of b relative to a at a contact line [m/s].
struct ConstraintSpeeds {
  std::array<double, 2> apart;  ///< at each end, along the normal
  double slip;                  ///< along the line
};

/// The constraint of a contact between two solver_bodies, without impulses.
ContactConstraint make_constraint(const Bodies& bodies, const Contact& contact, std::int32_t a,
                                  std::int32_t b, std::span<const SolverBody> solver_bodies);

ConstraintSpeeds speeds_at(const ContactConstraint& constraint, std::span<const SolverBody> solver_bodies);

/// What would bring both ends to rest, if no other body were there: the solution p of K p = approach, p ≥ 0
/// [N s].
double isolated_impulse(const ContactConstraint& constraint, const ConstraintSpeeds& speeds);

/// What a held body does to the other one, through its own motion [J].
double prescribed_work(const ContactConstraint& constraint, std::span<const SolverBody> solver_bodies,
                       const Bodies& bodies, const Contact& contact);

inline std::array<double, 2> apart_at(const ContactConstraint& constraint, const SolverBody& a,
                                      const SolverBody& b) {
  const double apart = dot(b.velocity - a.velocity, constraint.normal);
  return {apart + b.angular_velocity * constraint.arm_cross_normal_b[0] -
              a.angular_velocity * constraint.arm_cross_normal_a[0],
          apart + b.angular_velocity * constraint.arm_cross_normal_b[1] -
              a.angular_velocity * constraint.arm_cross_normal_a[1]};
}

/// Changes the velocities by impulses on b, and their opposites on a.
inline void apply_impulses(const ContactConstraint& constraint, double impulse_0, double impulse_1,
                           double slip_impulse, std::span<SolverBody> solver_bodies) {
  SolverBody& a = solver_bodies[constraint.a];
  SolverBody& b = solver_bodies[constraint.b];
  const geometry::Vector impulse =
      (impulse_0 + impulse_1) * constraint.normal + slip_impulse * perpendicular(constraint.normal);
  if (a.inverse_mass != 0) {  // a held body belongs to several islands: nobody may write it
    a.velocity -= a.inverse_mass * impulse;
    a.angular_velocity -= a.inverse_moment * (impulse_0 * constraint.arm_cross_normal_a[0] +
                                              impulse_1 * constraint.arm_cross_normal_a[1] +
                                              slip_impulse * constraint.arm_cross_tangent_a);
  }
  if (b.inverse_mass != 0) {
    b.velocity += b.inverse_mass * impulse;
    b.angular_velocity += b.inverse_moment * (impulse_0 * constraint.arm_cross_normal_b[0] +
                                              impulse_1 * constraint.arm_cross_normal_b[1] +
                                              slip_impulse * constraint.arm_cross_tangent_b);
  }
}

/// The normal impulses that bring both ends to rest within their bounds, the ends moving apart so fast.
inline std::array<double, 2> impulses_to_rest(const ContactConstraint& constraint,
                                              const std::array<double, 2>& apart) {
  const double before_0 = constraint.normal_impulse[0];
  const double before_1 = constraint.normal_impulse[1];
  double p0 =
      before_0 - (constraint.inverse_mass_at[1] * apart[0] - constraint.inverse_mass_between * apart[1]) *
                     constraint.inverse_determinant;
  double p1 =
      before_1 - (constraint.inverse_mass_at[0] * apart[1] - constraint.inverse_mass_between * apart[0]) *
                     constraint.inverse_determinant;
  const bool is_within = p0 >= constraint.least[0] && p1 >= constraint.least[1] && p0 <= constraint.limit &&
                         p1 <= constraint.limit;
  const bool is_beyond = (p0 > constraint.limit && p1 > constraint.limit) ||
                         (p0 < constraint.least[0] && p1 < constraint.least[1]);
  if (constraint.inverse_determinant == 0 ||
      !(is_within || is_beyond)) {  // the one end at its bound decides the other
    p0 = std::clamp(before_0 - apart[0] / constraint.inverse_mass_at[0], constraint.least[0],
                    constraint.limit);
    p1 = before_1 -
         (apart[1] + constraint.inverse_mass_between * (p0 - before_0)) / constraint.inverse_mass_at[1];
  }
  return {std::clamp(p0, constraint.least[0], constraint.limit),
          std::clamp(p1, constraint.least[1], constraint.limit)};
}

/// Brings both ends of a contact line to rest within their bounds, then its slip within the Coulomb cone.
/// Returns by how much that changed a velocity at the contact [m/s].
inline double solve_constraint(ContactConstraint& constraint, std::span<SolverBody> solver_bodies) {
  const SolverBody& a = solver_bodies[constraint.a];
  const SolverBody& b = solver_bodies[constraint.b];
  const std::array<double, 2> apart = apart_at(constraint, a, b);
  if (constraint.normal_impulse[0] == 0 && constraint.normal_impulse[1] == 0 && constraint.least[0] == 0 &&
      constraint.least[1] == 0 && constraint.slip_impulse == 0 && apart[0] >= 0 && apart[1] >= 0) {
    return 0;
  }
  const std::array<double, 2> impulses = impulses_to_rest(constraint, apart);
  const double change_0 = impulses[0] - constraint.normal_impulse[0];
  const double change_1 = impulses[1] - constraint.normal_impulse[1];
  constraint.normal_impulse[0] = impulses[0];
  constraint.normal_impulse[1] = impulses[1];

  const double arm_cross_normal_a =
      a.angular_velocity - a.inverse_moment * (change_0 * constraint.arm_cross_normal_a[0] +
                                               change_1 * constraint.arm_cross_normal_a[1]);
  const double arm_cross_normal_b =
      b.angular_velocity + b.inverse_moment * (change_0 * constraint.arm_cross_normal_b[0] +
                                               change_1 * constraint.arm_cross_normal_b[1]);
  const double slip = dot(b.velocity - a.velocity, perpendicular(constraint.normal)) +
                      arm_cross_normal_b * constraint.arm_cross_tangent_b -
                      arm_cross_normal_a * constraint.arm_cross_tangent_a;
  const double most = constraint.friction * (impulses[0] + impulses[1]);
  const double slip_before = constraint.slip_impulse;
  constraint.slip_impulse = std::clamp(slip_before - slip * constraint.slip_mass, -most, most);
  const double slip_change = constraint.slip_impulse - slip_before;
  apply_impulses(constraint, change_0, change_1, slip_change, solver_bodies);
  return std::max({std::abs(change_0) * constraint.inverse_mass_at[0],
                   std::abs(change_1) * constraint.inverse_mass_at[1],
                   std::abs(slip_change) * constraint.inverse_slip_mass});
}

}  // namespace polynya::dynamics
