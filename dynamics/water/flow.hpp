#pragma once

#include <algorithm>
#include <span>
#include <vector>

#include "dynamics/bodies.hpp"

namespace polynya::dynamics {

// Velocities that are the same everywhere and change over time. Directions are where a flow goes to, in radians
// from the x axis, counter-clockwise.

/// A velocity at an instant.
struct FlowRow {
  double time = 0;       ///< [s]
  double speed = 0;      ///< [m/s]
  double direction = 0;  ///< [rad]
  friend bool operator==(const FlowRow&, const FlowRow&) = default;

  geometry::Vector velocity() const;
};

/// The velocity at a time: as a vector linear between rows ascending in time, the first and last before and
/// after them.
geometry::Vector velocity_of(std::span<const FlowRow> rows, double time);
/// What flows by it has gone since time 0 [m].
geometry::Vector path_of(std::span<const FlowRow> rows, double time);

/// A velocity whose tip goes around an ellipse: along its major axis a cos(2π t/T + phase), across it, to port,
/// b sin(2π t/T + phase).
struct Tide {
  double period = 44714.16;  ///< T; that of M2 [s]
  double major = 0;          ///< a [m/s]
  double minor = 0;          ///< b; negative: it turns clockwise [m/s]
  double direction = 0;      ///< of the major axis [rad]
  double phase = 0;          ///< at time 0 [rad]
  friend bool operator==(const Tide&, const Tide&) = default;

  geometry::Vector velocity(double time) const;
  geometry::Vector path(double time) const;  ///< since time 0 [m]
};

/// The wind over the ice, everywhere the same.
struct Wind {
  geometry::Vector velocity;        ///< U_10, ten metres above the ice, over ground [m/s]
  std::vector<FlowRow> rows;        ///< if any, in its place
  double drag_coefficient = 0.002;  ///< C_a [-]
  double density = 1.3;             ///< ρ_a [kg/m³]

  geometry::Vector velocity_at(double time) const { return rows.empty() ? velocity : velocity_of(rows, time); }
  bool blows() const {
    const bool is_moving =
        velocity != geometry::Vector{} || std::ranges::any_of(rows, [](const FlowRow& row) { return row.speed != 0; });
    return is_moving && drag_coefficient > 0 && density > 0;
  }
  /// ½ ρ_a C_a |U_10| U_10 at a time, the force on a floe per area in plan [Pa]. The ice's own speed, 2 to 3 % of the
  /// wind's, is left out. Coefficients of pack ice are 1.2e-3 to 3e-3 [recall].
  geometry::Vector stress(double time) const {
    const geometry::Vector u = velocity_at(time);
    return 0.5 * density * drag_coefficient * length(u) * u;
  }
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
