#pragma once

#include <span>

#include "geometry/contact/contact_circles.hpp"

namespace polynya::geometry {

/// The two half-angles of the wedge of ice that a boundary makes at a place, against an inward direction.
struct WedgeAngles {
  double front = 0;  ///< to the boundary that follows the tip (counter-clockwise around the ice) [rad]
  double back = 0;   ///< to the boundary that comes before it [rad]
};

/// Measures the wedge over a length: from the tip, along the boundary either way to where it first leaves the
/// circle of radius `length` about the tip [m], and the angle of that chord with the unit vector `inward`.
/// Jagged edges and the short edges of earlier cusps so count by where they lead, not by which of them
/// happens to be touched. `tip_edge` starts at the tip or holds it.
WedgeAngles wedge_angles(const EdgeList& edges, std::uint32_t tip_edge, Point tip, Vector inward, double length);

/// The same over several lengths, ascending, one of `angles` each.
void wedge_angles(const EdgeList& edges, std::uint32_t tip_edge, Point tip, Vector inward,
                  std::span<const double> lengths, std::span<WedgeAngles> angles);

}  // namespace polynya::geometry
