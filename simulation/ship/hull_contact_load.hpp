#pragma once

#include <optional>

#include "dynamics/contact/contact.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/crushing.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// A contact of a hull with ice, with all that the laws of crushing, bending and splitting need.
struct HullContactLoad {
  const dynamics::Contact& contact;
  fracture::Ice ice;              ///< ice of the floe, with the flexural strength of this contact
  double impulse = 0;             ///< impulse j of Eq. (5) [N s]
  double hull_angle = 0;          ///< angle θ_s of the hull from the vertical [rad]
  geometry::WedgeAngles wedge{};  ///< half-angles of the ice wedge at the contact; 0 if its floe is too small to break
  double opening_angle = 0;       ///< opening angle of that wedge; 0 if the half-angles decide separately [rad]
  /// Outline of the ice edge on circles about the contact, if the bending model uses it.
  std::optional<fracture::EdgeOpenings> openings{};
  double penetration = 0;     ///< crushed depth ξ [m]
  double vertical_force = 0;  ///< vertical force V at ξ, by the law of crushing ice [N]
  double mean_speed = 0;      ///< mean rate of ξ since first contact [m/s]
  double normal_force = 0;    ///< normal force F_n on the facet while ice crushes [N]
  double stiffness = 0;       ///< dF_n/dξ [N/m]
  /// Fraction of a growth of the depth that is crushed; in the rest the ice edge bends away [-].
  double crushed_share = 1;
  /// Horizontal, vertical and tangential force over F_n.
  fracture::CrushingShares shares{};
};

/// Returns the crushing force F_n of a contact's overlap [N]. `hull_angle` is 0 for a vertical wall.
double crushing_force(const fracture::Ice& ice, const dynamics::Contact& c, double hull_angle);

/// Returns the size of a floe, √area [m].
double floe_size(const Population& population, BodyIndex body);

/// Returns the load of a contact between a hull and ice, by the law of crushing ice. Ice that can break bends away
/// under the hull while it crushes. Therefore only a part of the overlap with the undeformed ice is crushed.
HullContactLoad crushing_load_of(const Setup& setup, const Population& population, const dynamics::Contact& c);

/// Returns the same by the law of impulses: all of the overlap is crushed.
HullContactLoad collision_load_of(const Setup& setup, const Population& population, const dynamics::Contact& c);

/// Returns the load in the form that a bending model takes.
fracture::BendingLoad bending_load(const Setup& setup, const HullContactLoad& load);

}  // namespace polynya::simulation
