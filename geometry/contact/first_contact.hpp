#pragma once

#include <optional>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Where and when two outlines that move in straight lines without turning first meet.
struct FirstContact {
  double time = 0;  ///< from now on [s]
  Point point;      ///< where that point of a is now [m]
  Vector normal;    ///< unit, from a into b
};

/// The first contact of `a` and `b` at a time in [from, until] [s], b moving at `velocity` relative to a
/// [m/s]; both are counter-clockwise and in one frame. A time before 0 lies in the past. Outlines that only
/// slide along each other have none.
std::optional<FirstContact> first_contact(const Ring& a, const Ring& b, Vector velocity, double from, double until);

}  // namespace polynya::geometry
