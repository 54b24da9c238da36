#pragma once

#include <span>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Area, centre and second moment of a region of unit surface density.
struct Measures {
  double area = 0;           ///< nearest double of the exact area [m²], holes taken off
  Point centroid;            ///< [m]
  double second_moment = 0;  ///< polar, about the centroid: ∫|r − c|² dA [m⁴]
};

/// Measures of a polygon with holes (outer ring counter-clockwise, holes clockwise).
Measures measure(const Polygon& polygon);

/// Signed area of a ring, positive where it runs counter-clockwise: the nearest double of the exact area [m²]. NaN
/// where a coordinate is not finite.
double signed_area(const Ring& ring);

/// Length of all boundaries, holes included [m].
double perimeter(const Polygon& polygon);

/// Area of a polygon within |y| ≤ half_width, in doubles [m²].
double area_in_band(const Polygon& polygon, double half_width);

/// The area of a polygon of these very doubles, computed in rationals and rounded once [m²]. The outer ring
/// runs counter-clockwise, holes clockwise. NaN where a coordinate is not finite.
double exact_area(const Polygon& polygon);

/// Σ areas of `after` − Σ areas of `before` + Σ `terms`, computed in rationals and rounded once [m²]: what a
/// ledger of areas leaves over. Zero means that not a bit is missing; NaN that something is not finite.
double exact_balance(std::span<const Polygon* const> after, std::span<const Polygon* const> before,
                     std::span<const double> terms);

}  // namespace polynya::geometry
