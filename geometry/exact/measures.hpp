#pragma once

#include <span>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Area, centre and second moment of a region of unit surface density.
struct Measures {
  double area = 0;           ///< nearest double of the exact area without holes [m²]
  Point centroid;            ///< [m]
  double second_moment = 0;  ///< polar, about the centroid: ∫|r − c|² dA [m⁴]
};

/// Returns the measures of a polygon with holes (outer ring counter-clockwise, holes clockwise).
Measures measure(const Polygon& polygon);

/// Returns the signed area of a ring, positive if it runs counter-clockwise: the nearest double of the exact area [m²];
/// NaN if a coordinate is not finite.
double signed_area(const Ring& ring);

/// Returns the length of all boundaries, holes included [m].
double perimeter(const Polygon& polygon);

/// Returns the area of a polygon within |y| ≤ half_width, computed in doubles [m²].
double area_in_band(const Polygon& polygon, double half_width);

/// Returns the area of a polygon with exactly these doubles as coordinates, computed in rationals and rounded once
/// [m²]; NaN if a coordinate is not finite. The outer ring runs counter-clockwise, holes clockwise.
double exact_area(const Polygon& polygon);

/// Returns the remainder of a ledger of areas, Σ areas of `after` − Σ areas of `before` + Σ `terms`, computed in
/// rationals and rounded once [m²]. Zero means that not a bit is missing; NaN means that a value is not finite.
double exact_balance(std::span<const Polygon* const> after, std::span<const Polygon* const> before,
                     std::span<const double> terms);

}  // namespace polynya::geometry
