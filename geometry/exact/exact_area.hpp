#pragma once

#include <span>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The area of a polygon of these very doubles, computed in rationals and rounded once [m²]. The outer ring
/// runs counter-clockwise, holes clockwise. NaN where a coordinate is not finite.
double exact_area(const Polygon& polygon);

/// Σ areas of `after` − Σ areas of `before` + Σ `terms`, computed in rationals and rounded once [m²]: what a
/// ledger of areas leaves over. Zero means that not a bit is missing; NaN that
/// something is not finite.
double exact_balance(std::span<const Polygon* const> after, std::span<const Polygon* const> before,
                     std::span<const double> terms);

}  // namespace polynya::geometry
