#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/cut_report.hpp"

namespace polynya::app {

/// The parts of a path that lie in the ice of `before` and on no edge of the polygons it became: there the
/// path ends inside the ice, or only leads from hole to hole. Found in doubles, for the report.
std::vector<io::Dangling> find_dangling(const std::vector<geometry::Point>& path,
                                        const geometry::Polygon& before,
                                        const std::vector<geometry::Polygon>& after);

}  // namespace polynya::app
