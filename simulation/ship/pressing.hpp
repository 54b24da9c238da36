#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "elementary/elementary.hpp"
#include "fracture/splitting.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// A place where a crack may start, with the direction in which it would run.
struct CrackMouth {
  geometry::Point point;       ///< place in the water frame [m]
  geometry::Vector direction;  ///< unit vector into the ice
  const dynamics::Contact* contact = nullptr;
};

/// A contact that presses a floe.
struct PressedContact {
  const dynamics::Contact* contact = nullptr;
  geometry::Vector force;  ///< force on the floe [N]
  bool is_corner = false;  ///< true if a corner of the other body is inside the floe
};

/// A floe, and the contacts of one other body that presses it, with the forces of the step.
struct PressedFloe {
  BodyIndex floe = 0;
  std::vector<PressedContact> contacts{};
  std::vector<fracture::Push> pushes{};
  std::vector<CrackMouth> mouths{};
  double most = 0;  ///< largest force with which the pushes can open a crack [N]
};

/// Returns the other body of a contact.
inline BodyIndex other_of(const dynamics::Contact& c, BodyIndex floe) {
  return floe == c.b ? c.a : c.b;
}
/// Returns the normal of a contact that points into the floe.
inline geometry::Vector into_floe(const dynamics::Contact& c, BodyIndex floe) {
  return floe == c.b ? c.normal : -c.normal;
}

/// Returns the normal force of a contact in a step of length dt [s]; if its ice broke within the step, the force at
/// which it broke [N].
inline double normal_force_of(const dynamics::Contact& c, double dt) {
  return c.is_broken ? c.breaking_force : c.step_share / dt * c.total_normal_impulse();
}

/// Limits the force of a contact to the force at which its ice breaks, unless a smaller limit was set before [N]. If
/// the contact is found when its crushing force has already exceeded the limit, the ice broke at the fraction
/// (F_b/F)^(1/n) of the depth, with F ∝ ξ^n; the missed impulse is reduced accordingly.
inline void break_at(dynamics::Contact& c, double force) {
  const double most = std::fmin(c.crushing_force, c.breaking_force);
  if (force < c.breaking_force) c.breaking_force = force;
  if (c.missed_impulse == 0 || most <= force) return;
  const double exponent = c.crushing_stiffness * c.depth / c.crushing_force;
  const double share_of_force = force / most;
  c.missed_impulse *= share_of_force * (exponent > 0 ? elementary::pow(share_of_force, 1 / exponent) : 1);
}

/// Returns the force of a contact on one of its floes in a step of length dt [s], in the water frame; if its ice broke
/// within the step, the force at which it broke [N].
geometry::Vector force_on(const dynamics::Contact& contact, BodyIndex floe, double dt);

/// Returns an upper bound of the force with which the contacts of two bodies can open a crack in either of them [N]. It
/// is computed without the faces of corners, which take time. A force F on two faces whose own forces enclose an angle
/// δ is divided into two forces with a sum of at most F / cos(δ/2). At a corner of angle γ, or of 90° if γ is larger, δ
/// ≤ 180° − γ + 2 atan μ. The bound is infinite if γ is hardly larger than 2 atan μ.
double opening_bound(const Setup& setup, const Step& step, std::span<const dynamics::Contact> contacts);

/// Sets the contacts of a floe with one other body, and their pushes. `contacts` are all contacts of the two bodies.
void press(const Setup& setup, const Step& step, const dynamics::Bodies& bodies,
           std::span<const dynamics::Contact> contacts, PressedFloe& pressed);

/// Returns the split of a floe that is attributed to a contact, without the crack, which the caller sets.
PendingFracture split_by(const Setup& setup, const Step& step, const Population& population,
                         const dynamics::Contact& contact, BodyIndex floe);

/// Sets the places where the pushes may start a crack: the tip of each corner, and the middle between each contact and
/// the next.
void find_mouths(PressedFloe& pressed);

}  // namespace polynya::simulation
