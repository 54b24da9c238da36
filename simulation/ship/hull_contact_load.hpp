#pragma once

#include <optional>

#include "dynamics/contact/contact.hpp"
#include "fracture/bending/bending_model.hpp"
#include "fracture/crushing.hpp"
#include "geometry/contact/crack_path.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// One contact of a ship with ice, as the fracture laws see it.
struct HullContactLoad {
  const dynamics::Contact& contact;
  fracture::Ice ice;              ///< of the floe, with the flexural strength of this contact
  double impulse = 0;             ///< j of Eq. (5) [N s]
  double hull_angle = 0;          ///< θ_s [rad]
  geometry::WedgeAngles wedge{};  ///< of the ice, where its floe is large enough to break
  double opening_angle = 0;       ///< of that wedge; 0 where its half-angles decide alone [rad]
  /// Of the ice, likewise, where its outline decides what it bears.
  std::optional<fracture::EdgeOpenings> openings{};
  double penetration = 0;     ///< ξ that is crushed [m]
  double vertical_force = 0;  ///< V at ξ, by the law of crushing ice [N]
  double mean_speed = 0;      ///< of ξ's growth since first contact [m/s]
  double normal_force = 0;    ///< F_n on the facet while ice crushes [N]
  double stiffness = 0;       ///< dF_n/dξ [N/m]
  double crushed_share = 1;   ///< of a growth of the depth: the rest is the edge that bends away [-]
  fracture::CrushingShares shares{};
};

/// F_n at the contact's overlap, a hull's or a vertical wall's [N].
double crushing_force(const fracture::Ice& ice, const dynamics::Contact& c, double hull_angle);

/// √area [m].
double floe_size(const Population& population, BodyIndex body);

/// What a ship's contact with ice carries while the ice crushes, by the law of crushing ice. Ice that can break bends
/// away under the hull meanwhile, so that only a part of the overlap with the ice as it lay is crushed.
HullContactLoad crushing_load_of(const Setup& setup, const Population& population, const dynamics::Contact& c);

/// The same by the law of impulses: all of the overlap is crushed.
HullContactLoad collision_load_of(const Setup& setup, const Population& population, const dynamics::Contact& c);

/// The load as a bending model takes it.
fracture::BendingLoad bending_load(const Setup& setup, const HullContactLoad& load);

}  // namespace polynya::simulation
