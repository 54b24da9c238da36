#pragma once

#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {

/// The general path: the whole shape and the tool overlaid exactly by CGAL. Covers every valid input; costs
/// tens of milliseconds at thousands of vertices. Arguments are valid (checked by the caller); never throws.
CutOutcome cut_by_polygons_generally(const exact::Polygon& shape, const std::vector<Polygon>& tools_in_body);
CutOutcome cut_along_generally(const exact::Polygon& shape, const std::vector<Point>& polyline_in_body);

}  // namespace polynya::geometry
