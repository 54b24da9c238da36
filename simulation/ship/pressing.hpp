#pragma once

#include <cmath>
#include <span>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "elementary/elementary.hpp"
#include "fracture/splitting.hpp"
#include "simulation/world/world.hpp"

namespace polynya::simulation {

/// Where a crack may start.
struct CrackMouth {
  geometry::Point point;       ///< [m]
  geometry::Vector direction;  ///< unit, into the ice
  const dynamics::Contact* contact = nullptr;
};

/// A contact that presses a floe.
struct PressedContact {
  const dynamics::Contact* contact = nullptr;
  geometry::Vector force;  ///< on the floe [N]
  bool is_corner = false;  ///< the other body's corner is in the floe
};

/// A floe and one body that presses it, by the forces of the step at all of their contacts.
struct PressedFloe {
  BodyIndex floe = 0;
  std::vector<PressedContact> contacts;
  std::vector<fracture::Push> pushes;
  std::vector<CrackMouth> mouths;
  double most = 0;  ///< that the pushes can open a crack with [N]
};

inline BodyIndex other_of(const dynamics::Contact& c, BodyIndex floe) {
  return floe == c.b ? c.a : c.b;
}
inline geometry::Vector into_floe(const dynamics::Contact& c, BodyIndex floe) {
  return floe == c.b ? c.normal : -c.normal;
}

/// The normal force of a contact in the step; where its ice broke within the step, that at which it did [N].
inline double normal_force_of(const dynamics::Contact& c, double dt) {
  return c.is_broken ? c.breaking_force : c.steady_share / dt * c.total_normal_impulse();
}

/// The force at which a contact's ice breaks, no more than was entered before [N]. One that is found deeper
/// than that broke on the way, at the share (F_b/F)^(1/n) of its depth, with F ∝ ξ^n.
inline void break_at(dynamics::Contact& c, double force) {
  const double most = std::fmin(c.crushing_force, c.breaking_force);
  if (force < c.breaking_force) c.breaking_force = force;
  if (c.missed_impulse == 0 || most <= force) return;
  const double exponent = c.crushing_stiffness * c.depth / c.crushing_force;
  const double share_of_force = force / most;
  c.missed_impulse *= share_of_force * (exponent > 0 ? elementary::pow(share_of_force, 1 / exponent) : 1);
}

/// The force of a contact in the step; where its ice broke within the step, that at which it did [N].
geometry::Vector force_on(const dynamics::Contact& contact, BodyIndex floe, double dt);

/// No less than what the contacts of two bodies can open a crack with in either, found without the faces of
/// corners [N]. A force F on faces whose own forces enclose an angle δ splits in two of a sum ≤ F / cos(δ/2); at
/// a corner of γ, or 90° where it is more, δ ≤ 180° − γ + 2 atan μ. No bound where γ is little
/// more than 2 atan μ.
double opening_bound(const Setup& setup, const Step& step, std::span<const dynamics::Contact> contacts);

/// Enters the contacts of a floe with one other body, and their pushes.
void press(const Setup& setup, const Step& step, const dynamics::Bodies& bodies,
           std::span<const dynamics::Contact> contacts, PressedFloe& pressed);

/// The split of a floe by the force of a contact, without where and how it splits.
PendingFracture split_by(const Setup& setup, const Step& step, const Population& population,
                         const dynamics::Contact& contact, BodyIndex floe);

/// Enters where the pushes may start a crack: at a corner's tip, and between each contact and the next.
void find_mouths(PressedFloe& pressed);

}  // namespace polynya::simulation
