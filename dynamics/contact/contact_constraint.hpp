#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "dynamics/contact/contact.hpp"

namespace polynya::dynamics {

/// A body in the contact solver. It has a cache line to itself, since its neighbour may belong to another thread.
struct alignas(64) SolverBody {
  geometry::Vector velocity;  ///< of the centre of mass [m/s]
  double angular_velocity;    ///< [rad/s]
  double inverse_mass;        ///< 0: prescribed motion [1/kg]
  double inverse_moment;      ///< 0: prescribed motion [1/(kg m²)]
};

/// Copies the touching bodies to the solver; give_back_bodies copies the velocities that were found back.
void take_bodies(const Bodies& bodies, std::span<const BodyIndex> touched, std::span<SolverBody> solver_bodies);
void give_back_bodies(std::span<const SolverBody> solver_bodies, std::span<const BodyIndex> touched, Bodies& bodies);

/// The constraint of one contact line, with the impulses found so far; the indices 0 and 1 are its ends. J and K are
/// defined in contact_solver.hpp; K is singular if both ends turn the bodies alike.
struct ContactConstraint {
  std::int32_t a, b;  ///< indices of the solver bodies
  geometry::Vector normal;
  double arm_cross_normal_a[2], arm_cross_normal_b[2];  ///< r × n [m]
  double arm_cross_tangent_a, arm_cross_tangent_b;      ///< r × perpendicular(n), the same at both ends [m]
  double inverse_mass_at[2];                            ///< the diagonal of K [1/kg]
  double inverse_mass_between;                          ///< off-diagonal element of K [1/kg]
  double inverse_determinant;                           ///< 1 / det K; 0 where K is nearly singular [kg²]
  double inverse_slip_mass, slip_mass;  ///< speed along the line per slip impulse [1/kg], and its inverse
  double least[2];                      ///< smallest normal impulse: what restitution has added [N s]
  double limit;                         ///< largest normal impulse at each end [N s]
  double friction;                      ///< largest slip impulse per normal impulse [-]
  double normal_impulse[2];             ///< [N s]
  double slip_impulse;                  ///< [N s]
};

/// The velocity of b relative to a at a contact line [m/s].
struct ConstraintSpeeds {
  std::array<double, 2> apart;  ///< separating speed at each end, along the normal
  double slip;                  ///< speed along the line
};

/// Returns the constraint of a contact between two solver bodies, without impulses.
ContactConstraint make_constraint(const Bodies& bodies, const Contact& contact, std::int32_t a, std::int32_t b,
                                  std::span<const SolverBody> solver_bodies);

/// Returns the sum of the impulses p ≥ 0 that would bring both ends to rest if there were no other contacts, K p =
/// approach speeds [N s].
double isolated_impulse(const ContactConstraint& constraint, const ConstraintSpeeds& speeds);

/// Returns the work that a body with prescribed motion does on the other one through the contact's impulses [J].
double prescribed_work(const ContactConstraint& constraint, std::span<const SolverBody> solver_bodies,
                       const Bodies& bodies, const Contact& contact);

inline std::array<double, 2> apart_at(const ContactConstraint& k, const SolverBody& a, const SolverBody& b) {
  const double apart = dot(b.velocity - a.velocity, k.normal);
  return {apart + b.angular_velocity * k.arm_cross_normal_b[0] - a.angular_velocity * k.arm_cross_normal_a[0],
          apart + b.angular_velocity * k.arm_cross_normal_b[1] - a.angular_velocity * k.arm_cross_normal_a[1]};
}

inline ConstraintSpeeds speeds_at(const ContactConstraint& k, std::span<const SolverBody> solver_bodies) {
  const SolverBody& a = solver_bodies[k.a];
  const SolverBody& b = solver_bodies[k.b];
  return {apart_at(k, a, b), dot(b.velocity - a.velocity, perpendicular(k.normal)) +
                                 b.angular_velocity * k.arm_cross_tangent_b -
                                 a.angular_velocity * k.arm_cross_tangent_a};
}

/// Changes the velocities by impulses on b, and by the opposite impulses on a.
[[gnu::always_inline]] inline void apply_impulses(const ContactConstraint& k, double impulse_0, double impulse_1,
                                                  double slip_impulse, std::span<SolverBody> solver_bodies) {
  SolverBody& a = solver_bodies[k.a];
  SolverBody& b = solver_bodies[k.b];
  const geometry::Vector impulse = (impulse_0 + impulse_1) * k.normal + slip_impulse * perpendicular(k.normal);
  // A body with prescribed motion is shared by islands on several threads, so it is never written.
  if (a.inverse_mass != 0) {
    a.velocity -= a.inverse_mass * impulse;
    a.angular_velocity -=
        a.inverse_moment * (impulse_0 * k.arm_cross_normal_a[0] + impulse_1 * k.arm_cross_normal_a[1] +
                            slip_impulse * k.arm_cross_tangent_a);
  }
  if (b.inverse_mass != 0) {
    b.velocity += b.inverse_mass * impulse;
    b.angular_velocity +=
        b.inverse_moment * (impulse_0 * k.arm_cross_normal_b[0] + impulse_1 * k.arm_cross_normal_b[1] +
                            slip_impulse * k.arm_cross_tangent_b);
  }
}

/// Returns the normal impulses, within their bounds, that bring ends with these separating speeds to rest [N s].
inline std::array<double, 2> impulses_to_rest(const ContactConstraint& k, const std::array<double, 2>& apart) {
  const double before_0 = k.normal_impulse[0];
  const double before_1 = k.normal_impulse[1];
  double p0 = before_0 - (k.inverse_mass_at[1] * apart[0] - k.inverse_mass_between * apart[1]) * k.inverse_determinant;
  double p1 = before_1 - (k.inverse_mass_at[0] * apart[1] - k.inverse_mass_between * apart[0]) * k.inverse_determinant;
  const bool is_within = p0 >= k.least[0] && p1 >= k.least[1] && p0 <= k.limit && p1 <= k.limit;
  const bool is_beyond = (p0 > k.limit && p1 > k.limit) || (p0 < k.least[0] && p1 < k.least[1]);
  if (k.inverse_determinant == 0 || !(is_within || is_beyond)) {  // the end that is at its bound decides the other one
    p0 = std::clamp(before_0 - apart[0] / k.inverse_mass_at[0], k.least[0], k.limit);
    p1 = before_1 - (apart[1] + k.inverse_mass_between * (p0 - before_0)) / k.inverse_mass_at[1];
  }
  return {std::clamp(p0, k.least[0], k.limit), std::clamp(p1, k.least[1], k.limit)};
}

/// Returns the slip impulse that brings the slip of a contact line to rest, within the Coulomb cone of its normal
/// impulses [N s]. The last changes of the normal impulses, `change_0` and `change_1`, are not yet in the bodies.
inline double slip_to_rest(const ContactConstraint& k, const SolverBody& a, const SolverBody& b, double change_0,
                           double change_1) {
  const double omega_a =
      a.angular_velocity - a.inverse_moment * (change_0 * k.arm_cross_normal_a[0] + change_1 * k.arm_cross_normal_a[1]);
  const double omega_b =
      b.angular_velocity + b.inverse_moment * (change_0 * k.arm_cross_normal_b[0] + change_1 * k.arm_cross_normal_b[1]);
  const double slip = dot(b.velocity - a.velocity, perpendicular(k.normal)) + omega_b * k.arm_cross_tangent_b -
                      omega_a * k.arm_cross_tangent_a;
  const double most = k.friction * (k.normal_impulse[0] + k.normal_impulse[1]);
  return std::clamp(k.slip_impulse - slip * k.slip_mass, -most, most);
}

/// Brings both ends of a contact line to rest within their bounds, and then its slip within the Coulomb cone. Returns
/// the largest change of a speed at the contact [m/s].
inline double solve_constraint(ContactConstraint& k, std::span<SolverBody> solver_bodies) {
  const SolverBody& a = solver_bodies[k.a];
  const SolverBody& b = solver_bodies[k.b];
  const std::array<double, 2> apart = apart_at(k, a, b);
  if (k.normal_impulse[0] == 0 && k.normal_impulse[1] == 0 && k.least[0] == 0 && k.least[1] == 0 &&
      k.slip_impulse == 0 && apart[0] >= 0 && apart[1] >= 0) {
    return 0;
  }
  const std::array<double, 2> impulses = impulses_to_rest(k, apart);
  const double change_0 = impulses[0] - k.normal_impulse[0];
  const double change_1 = impulses[1] - k.normal_impulse[1];
  k.normal_impulse[0] = impulses[0];
  k.normal_impulse[1] = impulses[1];
  const double slip_before = k.slip_impulse;
  k.slip_impulse = slip_to_rest(k, a, b, change_0, change_1);
  const double slip_change = k.slip_impulse - slip_before;
  apply_impulses(k, change_0, change_1, slip_change, solver_bodies);
  return std::max({std::abs(change_0) * k.inverse_mass_at[0], std::abs(change_1) * k.inverse_mass_at[1],
                   std::abs(slip_change) * k.inverse_slip_mass});
}

}  // namespace polynya::dynamics
