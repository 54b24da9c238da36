#pragma once

#include <span>
#include <vector>

#include "dynamics/contact/contact.hpp"
#include "fracture/splitting.hpp"
#include "simulation/world/population.hpp"

namespace polynya::simulation {

/// Where a crack may start.
struct Mouth {
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
  std::vector<PressedContact> contacts;
  std::vector<fracture::Push> pushes;
  std::vector<Mouth> mouths;
  double most = 0;  ///< that the pushes can open a crack with [N]
};

inline BodyIndex other_of(const dynamics::Contact& c, BodyIndex floe) {
  return floe == c.b ? c.a : c.b;
}
inline geometry::Vector into_floe(const dynamics::Contact& c, BodyIndex floe) {
  return floe == c.b ? c.normal : -c.normal;
}

/// The force of a contact in the step; where its ice broke within the step, that at which it did [N].
geometry::Vector force_on(const dynamics::Contact& contact, BodyIndex floe, double dt);

/// No less than what the contacts of two bodies can open a crack with in either, found without the faces of
/// corners [N]. A force F on faces whose own forces enclose an angle δ splits in two of a sum ≤ F / cos(δ/2); at
/// a corner of γ, or 90° where it is more, δ ≤ 180° − γ + 2 atan μ. No bound where γ is little
/// more than 2 atan μ.
double opening_bound(const Setup& setup, std::span<const dynamics::Contact> contacts);

/// Enters the contacts of a floe with one other body, and their pushes.
void press(const Setup& setup, const dynamics::Bodies& bodies, std::span<const dynamics::Contact> contacts,
           BodyIndex floe, PressedFloe& pressed);

/// Enters where the pushes may start a crack: at a corner's tip, and between each contact and the next.
void find_mouths(BodyIndex floe, PressedFloe& pressed);

}  // namespace polynya::simulation
