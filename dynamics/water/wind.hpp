#pragma once

#include <span>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

/// The wind over the ice, everywhere the same.
struct Wind {
  geometry::Vector velocity;        ///< U_10, ten metres above the ice, over ground [m/s]
  double drag_coefficient = 0.002;  ///< C_a [-]
  double density = 1.3;             ///< ρ_a [kg/m³]

  bool blows() const { return velocity != geometry::Vector{} && drag_coefficient > 0 && density > 0; }
  /// ½ ρ_a C_a |U_10| U_10, the force on a floe per area in plan [Pa]. The ice's own speed, 2 to 3 % of the
  /// wind's, is left out. Coefficients of pack ice are 1.2e-3 to 3e-3 [recall].
  geometry::Vector stress() const { return 0.5 * density * drag_coefficient * length(velocity) * velocity; }
  friend bool operator==(const Wind&, const Wind&) = default;
};

/// What the wind did to the bodies over a step.
struct WindWork {
  double energy = 0;         ///< given [J]
  geometry::Vector impulse;  ///< on them all together [N s]
  double impulses = 0;       ///< sum of the impulses' sizes [N s]
};

/// Pushes floes by a stress [Pa] on their area in plan over dt [s]. It acts at the centre of mass, and turns
/// nothing: evenly spread, it has no moment about that.
WindWork apply_wind(Bodies& bodies, std::span<const BodyIndex> floes, geometry::Vector stress, double dt);

}  // namespace polynya::dynamics
