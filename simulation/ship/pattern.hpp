#pragma once

#include "geometry/shape/polygon.hpp"
#include "simulation/ship/sailing_settings.hpp"

namespace polynya::simulation {

// The lines along which ships sail that manage ice. In the frame of a pattern, x runs upstream from the protected body,
// against the drift of the ice, and y runs across it, to port of a ship that heads upstream.

/// A closed line: the corners of a pattern in their order, and the distance along the line from the first corner to
/// each.
struct PatternLine {
  geometry::Ring corners;
  std::vector<double> arc_length;  ///< distance to each corner; the last element is the length of the whole lap [m]

  double lap() const { return arc_length.back(); }
  std::size_t next(std::size_t corner) const { return (corner + 1) % corners.size(); }
  /// Returns the number of the leg that contains a place on the lap, 0 ≤ place < lap [m]. Leg i runs from corner i to
  /// the next.
  std::size_t leg_at(double place) const;
  /// Returns the point at a place on the lap [m].
  geometry::Point at(double place) const;
  geometry::Vector direction(std::size_t leg) const;  ///< unit vector along a leg
  /// Returns true if the direction changes by more than 60° at the end of a leg, so that a ship turns there instead of
  /// following a curve.
  bool is_sharp_after(std::size_t leg) const;
};

/// Returns the line of a pattern. The pattern kLargestFloe has no line; it gets the ellipse of kCircular, which no ship
/// follows.
PatternLine line_of(const ManagingPilot& pilot);

/// Returns the smallest distance between two ships that sail round a pattern together, one of them ahead by a fraction
/// of a lap [m].
double least_distance(const PatternLine& line, double ahead);

}  // namespace polynya::simulation
