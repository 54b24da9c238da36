#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The double nearest to the exact signed area of the ring [m²]: positive where it runs counter-clockwise.
/// NaN where a coordinate is not finite.
double nearest_area(const Ring& ring);

/// The same of a polygon, its holes (which run clockwise) taken off.
double nearest_area(const Polygon& polygon);

}  // namespace polynya::geometry
