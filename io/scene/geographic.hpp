#pragma once

#include "geometry/shape/point.hpp"
#include "simulation/scene.hpp"

namespace polynya::io {

/// A place on WGS 84.
struct Geographic {
  double latitude = 0;   ///< [rad]
  double longitude = 0;  ///< [rad]; continuous around the origin's, so it may leave ±π
};

/// Where a point of the scene's plane lies: the plane is tangent to the ellipsoid at the origin, the point is
/// taken down to it along the ellipsoid's normal. Local east, north → geocentric → geodetic [Bowring1976],
/// iterated to rounding. Distances are right to d²/(2 R²) of themselves: 3 mm over 10 km.
Geographic geographic_of(const simulation::GeographicOrigin& origin, geometry::Point point);

}  // namespace polynya::io
