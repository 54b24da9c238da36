#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The area of a polygon within |y| ≤ half_width, in doubles [m²].
double area_in_band(const Polygon& polygon, double half_width);

}  // namespace polynya::geometry
