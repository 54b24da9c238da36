#pragma once

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// A straight path through a floe, from a point on or near its boundary to its far side.
struct CrackPath {
  Point start;               ///< just outside the ice behind the point [m]
  Point end;                 ///< just outside the ice on the far side [m]
  double length_in_ice = 0;  ///< [m]
};

/// The path from `point` along the unit `direction` through all ice ahead of it. `margin` [m] is how far
/// outside the ice its ends lie, so that a cut along it separates. Measured in doubles; the cut itself is
/// exact. Tests only edges near the line where the boundary is ready.
CrackPath crack_path(const Boundary& boundary, Point point, Vector direction, double margin);

}  // namespace polynya::geometry
