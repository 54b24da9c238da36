#pragma once

#include "geometry/shape/shape.hpp"

namespace polynya::geometry {

/// Area, centre and second moment of a region of unit surface density.
struct Measures {
  double area = 0;           ///< nearest double of the exact area [m²], holes taken off
  Point centroid;            ///< [m]
  double second_moment = 0;  ///< polar, about the centroid: ∫|r − c|² dA [m⁴]
};

/// Measures of a polygon with holes (outer ring counter-clockwise, holes clockwise).
Measures measure(const Polygon& polygon);

/// Signed area of a ring, positive where it runs counter-clockwise: the nearest double of the exact area
/// [m²].
double signed_area(const Ring& ring);

/// Length of all boundaries, holes included [m].
double perimeter(const Polygon& polygon);

/// Is the point inside or on the boundary of the polygon? (even-odd, exact predicate)
bool contains(const Polygon& polygon, Point point);

}  // namespace polynya::geometry
