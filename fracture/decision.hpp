#pragma once

namespace polynya::fracture {

/// What happens at one contact between a ship and a floe. Section 8 of docs/theory.md.
enum class Failure { kNone, kCrush, kBend, kSplit };

/// Both sides of each criterion at one contact, so that a record can state them.
struct FailureCriteria {
  double floe_size = 0;         ///< L = √area [m]
  double breakable_size = 0;    ///< κ l [m]
  double collision_force = 0;   ///< j / τ_c of Eq. (5) [N]
  double splitting_force = 0;   ///< F_s [N]; of use only where crack_length ≥ breakable_size
  double crack_length = 0;      ///< path of the crack in ice [m]
  bool has_ice_beside = true;   ///< ice on both sides of the crack's mouth; else it would only pare the edge
  double vertical_force = 0;    ///< V of the crushing contact, down on the ice [N]
  double bending_capacity = 0;  ///< V_b [N]
};

/// Small floes are pushed away; else a hard enough hit splits; else ice pressed down enough breaks off a
/// cusp; else the contact crushes.
constexpr Failure decide(const FailureCriteria& c) {
  if (c.floe_size < c.breakable_size) return Failure::kNone;
  const bool can_crack = c.crack_length >= c.breakable_size && c.has_ice_beside;
  if (can_crack && c.collision_force > c.splitting_force) return Failure::kSplit;
  if (c.vertical_force > 0 && c.vertical_force >= c.bending_capacity) return Failure::kBend;
  return Failure::kCrush;
}

}  // namespace polynya::fracture
