#pragma once

namespace polynya::fracture {

/// The outcome at one contact between a hull, of a ship or a structure, and a floe (docs/theory/decision.md).
enum class Failure { kNone, kCrush, kBend, kSplit };

/// Both sides of each criterion at one contact, so that a record can state them.
struct FailureCriteria {
  double floe_size = 0;          ///< L = √area [m]
  double breakable_size = 0;     ///< κ l [m]
  double contact_force = 0;      ///< force that really acts at the contact in the step [N]
  double vertical_force = 0;     ///< V of the crushing contact, down on the ice [N]
  double bending_capacity = 0;   ///< V_b [N]
  double flexural_strength = 0;  ///< σ_f of V_b, with the scatter of bending events, or of a beam; 0: no bend [Pa]

  // The crack of both splitting rules:
  double crack_length = 0;     ///< L, length of its path in ice; 0: there is no crack [m]
  double crack_width = 0;      ///< W: twice the width of the ice on its narrower side, where the force peaks [m]
  bool leaves_sliver = false;  ///< the crack would leave a sliver, so it does not count

  // Splitting by Eq. (4), with j/τ_c:
  double collision_force = 0;  ///< j / τ_c of Eq. (5) [N]
  double splitting_force = 0;  ///< F_s; meaningful only if crack_length > 0; 0 if the rule is not used [N]

  // Splitting by the true forces, for the same crack:
  double flank_forces[2] = {0, 0};  ///< forces that push the ice on its left and right apart [N]
  double opening_force = 0;         ///< F, the smaller of the two [N]
  double opening_capacity = 0;      ///< F_max [N]
  double fracture_toughness = 0;    ///< K_IC [Pa √m]

  // For a floe that breaks across as a beam (beam.hpp):
  double section_stress = 0;  ///< σ where it breaks; 0 for all other cases [Pa]

  /// For a split by the true forces: returns the force or stress that breaks the floe over the one that it withstands.
  constexpr double split_share() const {
    return section_stress > 0 ? section_stress / flexural_strength : opening_force / opening_capacity;
  }
};

/// Decides what happens at a contact. Small floes are pushed away. Otherwise a strong enough hit splits the floe by the
/// paper's rule; otherwise ice that is pressed down strongly enough breaks off a cusp; otherwise the contact crushes.
/// Splits by the true forces are found elsewhere, after the solver; without the paper's rule `crack_length` is 0 here.
constexpr Failure decide(const FailureCriteria& c) {
  if (c.floe_size < c.breakable_size) return Failure::kNone;
  const bool can_crack = c.crack_length > 0 && !c.leaves_sliver;
  if (can_crack && c.collision_force > c.splitting_force) return Failure::kSplit;
  if (c.vertical_force > 0 && c.vertical_force >= c.bending_capacity) return Failure::kBend;
  return Failure::kCrush;
}

}  // namespace polynya::fracture
