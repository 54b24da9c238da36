#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/cut.hpp"

namespace polynya::geometry {

/// The general path on the window around the cut: only the edges near the tool are overlaid with it exactly,
/// all others are carried over as whole stretches. Equal to the general path wherever it answers; none where
/// it cannot tell (then the general path does). Shape and tools are valid.
std::optional<CutOutcome> cut_by_polygons_in_window(const Shape& shape,
                                                    const std::vector<Polygon>& tools_in_body);
std::optional<CutOutcome> cut_along_in_window(const Shape& shape, const std::vector<Point>& polyline_in_body);

}  // namespace polynya::geometry
