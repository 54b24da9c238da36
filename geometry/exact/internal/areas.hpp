#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// A ring's signed area with generous bounds on its errors: within them, decide in rationals.
struct RingArea {
  double area = 0;       ///< compensated sum about the ring's first vertex [m²]
  double doubt = 0;      ///< |area − exact area of these vertices| is below this [m²]
  double step_area = 0;  ///< area by which moving every vertex by one step between doubles can change it [m²]
};

/// One pass over the vertices.
RingArea ring_area(const Ring& ring);

/// The polygon's area by its rings' [m²]: within 1e-6 of the exact one as a bound, within some 1e-15 as a
/// rule; the nearest double where the bounds leave that open.
double area_of(const Polygon& polygon, const std::vector<RingArea>& rings);
double area_of(const Polygon& polygon);

/// The double nearest to the exact signed area of the ring [m²]: positive where it runs counter-clockwise.
/// NaN where a coordinate is not finite.
double nearest_area(const Ring& ring);
/// The same of a polygon, its holes (which run clockwise) taken off.
double nearest_area(const Polygon& polygon);

}  // namespace polynya::geometry
