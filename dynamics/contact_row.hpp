#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "dynamics/contact.hpp"

namespace polynya::dynamics {

/// A body's velocity while it is being solved for.
struct Mover {
  geometry::Vector velocity;  ///< of the centre of mass [m/s]
  double angular_velocity;    ///< [rad/s]
  double inverse_mass;        ///< 0: held [1/kg]
  double inverse_moment;      ///< 0: held [1/(kg m²)]
};

/// One contact line as its two bodies feel it, with the impulses found so far; [0] and [1] are its ends.
struct ContactRow {
  std::int32_t a, b;  ///< movers
  geometry::Vector normal;
  double turn_a[2], turn_b[2];      ///< arm × normal [m]
  double slip_turn_a, slip_turn_b;  ///< arm × perpendicular(normal), the same at both ends [m]
  double softness[2];               ///< velocity per impulse, at each end by its own [1/kg]
  double coupling;                  ///< at one end by the other's [1/kg]
  double stiffness;                 ///< 1 / determinant of the two; 0 where they do not differ [kg²]
  double slip_softness, slip_mass;  ///< velocity along the line per impulse [1/kg], and its inverse
  double least[2];                  ///< of the normal impulse: what restitution gave [N s]
  double limit;                     ///< of the normal impulse at each end [N s]
  double friction;                  ///< most slip impulse per normal impulse [-]
  double normal_impulse[2];         ///< [N s]
  double slip_impulse;              ///< [N s]
};

/// Velocity of b relative to a at a contact line [m/s].
struct RowSpeeds {
  std::array<double, 2> apart;  ///< at each end, along the normal
  double slip;                  ///< along the line
};

/// The row of a contact between two movers, without impulses.
ContactRow make_row(const Bodies& bodies, const Contact& contact, std::int32_t a, std::int32_t b,
                    std::span<const Mover> movers);

RowSpeeds speeds_at(const ContactRow& row, std::span<const Mover> movers);

/// What would bring both ends to rest, if no other body were there: the solution p of K p = approach, p ≥ 0
/// [N s].
double isolated_impulse(const ContactRow& row, const RowSpeeds& speeds);

/// What a held body does to the other one, through its own motion [J].
double held_work(const ContactRow& row, std::span<const Mover> movers, const Bodies& bodies,
                 const Contact& contact);

inline std::array<double, 2> apart_at(const ContactRow& row, const Mover& a, const Mover& b) {
  const double apart = dot(b.velocity - a.velocity, row.normal);
  return {apart + b.angular_velocity * row.turn_b[0] - a.angular_velocity * row.turn_a[0],
          apart + b.angular_velocity * row.turn_b[1] - a.angular_velocity * row.turn_a[1]};
}

/// Changes the velocities by impulses on b, and their opposites on a.
inline void push(const ContactRow& row, double impulse_0, double impulse_1, double slip_impulse,
                 std::span<Mover> movers) {
  Mover& a = movers[row.a];
  Mover& b = movers[row.b];
  const geometry::Vector impulse =
      (impulse_0 + impulse_1) * row.normal + slip_impulse * perpendicular(row.normal);
  if (a.inverse_mass != 0) {  // a held body belongs to several islands: nobody may write it
    a.velocity -= a.inverse_mass * impulse;
    a.angular_velocity -= a.inverse_moment * (impulse_0 * row.turn_a[0] + impulse_1 * row.turn_a[1] +
                                              slip_impulse * row.slip_turn_a);
  }
  if (b.inverse_mass != 0) {
    b.velocity += b.inverse_mass * impulse;
    b.angular_velocity += b.inverse_moment * (impulse_0 * row.turn_b[0] + impulse_1 * row.turn_b[1] +
                                              slip_impulse * row.slip_turn_b);
  }
}

/// The normal impulses that bring both ends to rest within their bounds, the ends moving apart so fast.
inline std::array<double, 2> impulses_to_rest(const ContactRow& row, const std::array<double, 2>& apart) {
  const double before_0 = row.normal_impulse[0];
  const double before_1 = row.normal_impulse[1];
  double p0 = before_0 - (row.softness[1] * apart[0] - row.coupling * apart[1]) * row.stiffness;
  double p1 = before_1 - (row.softness[0] * apart[1] - row.coupling * apart[0]) * row.stiffness;
  const bool is_within = p0 >= row.least[0] && p1 >= row.least[1] && p0 <= row.limit && p1 <= row.limit;
  const bool is_beyond = (p0 > row.limit && p1 > row.limit) || (p0 < row.least[0] && p1 < row.least[1]);
  if (row.stiffness == 0 || !(is_within || is_beyond)) {  // the one end at its bound decides the other
    p0 = std::clamp(before_0 - apart[0] / row.softness[0], row.least[0], row.limit);
    p1 = before_1 - (apart[1] + row.coupling * (p0 - before_0)) / row.softness[1];
  }
  return {std::clamp(p0, row.least[0], row.limit), std::clamp(p1, row.least[1], row.limit)};
}

/// Brings both ends of a contact line to rest within their bounds, then its slip within the Coulomb cone.
/// Returns by how much that changed a velocity at the contact [m/s].
inline double visit(ContactRow& row, std::span<Mover> movers) {
  const Mover& a = movers[row.a];
  const Mover& b = movers[row.b];
  const std::array<double, 2> apart = apart_at(row, a, b);
  if (row.normal_impulse[0] == 0 && row.normal_impulse[1] == 0 && row.least[0] == 0 && row.least[1] == 0 &&
      row.slip_impulse == 0 && apart[0] >= 0 && apart[1] >= 0) {
    return 0;
  }
  const std::array<double, 2> impulses = impulses_to_rest(row, apart);
  const double change_0 = impulses[0] - row.normal_impulse[0];
  const double change_1 = impulses[1] - row.normal_impulse[1];
  row.normal_impulse[0] = impulses[0];
  row.normal_impulse[1] = impulses[1];

  const double turn_a =
      a.angular_velocity - a.inverse_moment * (change_0 * row.turn_a[0] + change_1 * row.turn_a[1]);
  const double turn_b =
      b.angular_velocity + b.inverse_moment * (change_0 * row.turn_b[0] + change_1 * row.turn_b[1]);
  const double slip = dot(b.velocity - a.velocity, perpendicular(row.normal)) + turn_b * row.slip_turn_b -
                      turn_a * row.slip_turn_a;
  const double most = row.friction * (impulses[0] + impulses[1]);
  const double slip_before = row.slip_impulse;
  row.slip_impulse = std::clamp(slip_before - slip * row.slip_mass, -most, most);
  const double slip_change = row.slip_impulse - slip_before;
  push(row, change_0, change_1, slip_change, movers);
  return std::max({std::abs(change_0) * row.softness[0], std::abs(change_1) * row.softness[1],
                   std::abs(slip_change) * row.slip_softness});
}

}  // namespace polynya::dynamics
