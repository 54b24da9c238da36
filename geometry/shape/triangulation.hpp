#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Triangles by their corners' numbers, counted over the outer ring and then the holes, in order.
using Triangle = std::array<std::uint32_t, 3>;

/// The constrained Delaunay triangulation of a valid polygon with holes, counter-clockwise triangles, no new
/// corners. Decided exactly. Empty where the polygon is not valid enough to be triangulated so (rings that
/// cross themselves, or have all their points on a line).
std::vector<Triangle> triangulate(const Polygon& polygon);

}  // namespace polynya::geometry
