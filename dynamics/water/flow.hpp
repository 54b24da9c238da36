#pragma once

#include <optional>
#include <span>
#include <vector>

#include "geometry/shape/point.hpp"

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

}  // namespace polynya::dynamics
