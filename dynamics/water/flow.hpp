#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

// Velocities that are the same everywhere and change over time. A direction is the one towards which the flow moves,
// in radians from the x axis, counter-clockwise.

/// A velocity at an instant.
struct FlowRow {
  double time = 0;       ///< [s]
  double speed = 0;      ///< [m/s]
  double direction = 0;  ///< [rad]
  friend bool operator==(const FlowRow&, const FlowRow&) = default;

  geometry::Vector velocity() const;
};

/// Returns the velocity at a time: interpolated linearly, as a vector, between rows in ascending order of time. Before
/// the first and after the last row it is theirs.
geometry::Vector velocity_of(std::span<const FlowRow> rows, double time);
/// Returns the displacement since time 0 of a particle that moves with this velocity [m].
geometry::Vector path_of(std::span<const FlowRow> rows, double time);

/// A velocity whose tip moves around an ellipse: a cos(2π t/T + phase) along its major axis, and b sin(2π t/T + phase)
/// across it, to port.
struct Tide {
  double period = 44714.16;  ///< T; the default is the period of the M2 tide [s]
  double major = 0;          ///< a [m/s]
  double minor = 0;          ///< b; negative: it turns clockwise [m/s]
  double direction = 0;      ///< of the major axis [rad]
  double phase = 0;          ///< at time 0 [rad]
  friend bool operator==(const Tide&, const Tide&) = default;

  geometry::Vector velocity(double time) const;
  geometry::Vector path(double time) const;  ///< displacement since time 0 [m]
};

/// The wind over the ice, the same everywhere.
struct Wind {
  geometry::Vector velocity;        ///< U_10, ten metres above the ice, over ground [m/s]
  std::vector<FlowRow> rows;        ///< if not empty, used instead of `velocity`
  double drag_coefficient = 0.002;  ///< C_a [-]
  double density = 1.3;             ///< ρ_a [kg/m³]

  geometry::Vector velocity_at(double time) const { return rows.empty() ? velocity : velocity_of(rows, time); }
  bool blows() const {
    const bool is_moving =
        velocity != geometry::Vector{} || std::ranges::any_of(rows, [](const FlowRow& row) { return row.speed != 0; });
    return is_moving && drag_coefficient > 0 && density > 0;
  }
  /// Returns ½ ρ_a C_a |U_10| U_10 at a time, the force on a floe per area in plan [Pa]. The speed of the ice itself, 2
  /// to 3 % of the wind's, is left out. Coefficients of pack ice are 1.2e-3 to 3e-3 [recall].
  geometry::Vector stress(double time) const {
    const geometry::Vector u = velocity_at(time);
    return 0.5 * density * drag_coefficient * length(u) * u;
  }
  friend bool operator==(const Wind&, const Wind&) = default;
};

/// The effect of the wind on the bodies over a step.
struct WindWork {
  double energy = 0;         ///< energy given to the bodies [J]
  geometry::Vector impulse;  ///< sum of the impulses on all bodies [N s]
  double impulses = 0;       ///< sum of the magnitudes of the impulses [N s]
};

/// Pushes floes with a stress [Pa] on their area in plan over dt [s]. The force acts at the centre of mass and does not
/// turn a floe, since a uniform stress has no moment about it.
WindWork apply_wind(Bodies& bodies, std::span<const BodyIndex> floes, geometry::Vector stress, double dt);

}  // namespace polynya::dynamics
