#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The convex hull of points, counter-clockwise from the lowest one, without points on its edges. Exact, by
/// CGAL.
Ring convex_hull(const std::vector<Point>& points);

}  // namespace polynya::geometry
