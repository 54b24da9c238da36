#pragma once

#include "geometry/shape/polygon.hpp"
#include "simulation/ship/sailing_settings.hpp"

namespace polynya::simulation {

// Where patterns of ice management lead. In a pattern's axes x runs upstream from the protected body, against the
// drift of the ice, and y across it, to port of upstream.

/// A closed line: the corners of a pattern in their order, and the way to each from the first one.
struct PatternLine {
  geometry::Ring corners;
  std::vector<double> way;  ///< one more than corners: the last is the lap's length [m]

  double lap() const { return way.back(); }
  std::size_t next(std::size_t corner) const { return (corner + 1) % corners.size(); }
  /// The leg, from its corner to the next, that a place on the lap is on; 0 ≤ place < lap [m].
  std::size_t leg_at(double place) const;
  geometry::Point at(double place) const;
  geometry::Vector direction(std::size_t leg) const;  ///< of length 1
  /// Whether a ship turns about at a leg's end, by more than 60°, in place of going round.
  bool is_sharp_after(std::size_t leg) const;
};

/// Of a pattern other than kLargestFloe.
PatternLine line_of(const ManagingPilot& pilot);

/// How near two ships come that go round a pattern together, one by a share of a lap ahead of the other [m].
double least_distance(const PatternLine& line, double ahead);

}  // namespace polynya::simulation
