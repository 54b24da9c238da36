#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// A valid polygon with vertices left out: each one given lies within `tolerance` [m] of the boundary that is
/// left. The vertices kept are among those given, and no ring crosses itself or another. By CGAL's polyline
/// simplification, which keeps the topology; the polygon as it is where CGAL refuses it.
Polygon simplified(const Polygon& polygon, double tolerance);

}  // namespace polynya::geometry
