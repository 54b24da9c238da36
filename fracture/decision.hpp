#pragma once

namespace polynya::fracture {

/// What happens at one contact between a ship and a floe. docs/theory/decision.md.
enum class Failure { kNone, kCrush, kBend, kSplit };

/// Both sides of each criterion at one contact, so that a record can state them.
struct FailureCriteria {
  double floe_size = 0;          ///< L = √area [m]
  double breakable_size = 0;     ///< κ l [m]
  double contact_force = 0;      ///< the true one of the contact in the step [N]
  double vertical_force = 0;     ///< V of the crushing contact, down on the ice [N]
  double bending_capacity = 0;   ///< V_b [N]
  double flexural_strength = 0;  ///< σ_f that V_b, with the scatter of bending events, or a beam is of; 0: no bend [Pa]

  // The crack:
  double crack_length = 0;     ///< L, its path in ice; 0 where there is none [m]
  double crack_width = 0;      ///< W: twice the ice on its narrower side, where the force peaks [m]
  bool leaves_sliver = false;  ///< it would leave a sliver: it does not count

  // Splitting by Eq. (4), with j/τ_c:
  double collision_force = 0;  ///< j / τ_c of Eq. (5) [N]
  double splitting_force = 0;  ///< F_s, of use only where crack_length > 0; 0 where the rule is not in use [N]

  // Splitting by the true forces, on the same crack:
  double flank_forces[2] = {0, 0};  ///< that push the ice on its left and right apart [N]
  double opening_force = 0;         ///< F, the lesser of them [N]
  double opening_capacity = 0;      ///< F_max [N]
  double fracture_toughness = 0;    ///< K_IC [Pa √m]

  // Of a floe that breaks across as a beam (beam.hpp):
  double section_stress = 0;  ///< σ where it breaks; 0 of all else [Pa]

  /// Of a split by the true forces: what breaks the floe, over what it bears.
  constexpr double split_share() const {
    return section_stress > 0 ? section_stress / flexural_strength : opening_force / opening_capacity;
  }
};

/// Small floes are pushed away; else a hard enough hit splits; else ice pressed down enough breaks off a
/// cusp; else the contact crushes.
constexpr Failure decide(const FailureCriteria& c) {
  if (c.floe_size < c.breakable_size) return Failure::kNone;
  const bool can_crack = c.crack_length > 0 && !c.leaves_sliver;
  if (can_crack && c.collision_force > c.splitting_force) return Failure::kSplit;
  if (c.vertical_force > 0 && c.vertical_force >= c.bending_capacity) return Failure::kBend;
  return Failure::kCrush;
}

}  // namespace polynya::fracture
