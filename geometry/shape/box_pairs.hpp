#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "geometry/shape/box.hpp"

namespace polynya::geometry {

/// Which boxes meet, touching ones too, by their indices: the lower first, ascending. By CGAL's box
/// intersection, in n log² n and what there is to find.
std::vector<std::pair<std::size_t, std::size_t>> pairs_of_boxes(const std::vector<Box>& boxes);

}  // namespace polynya::geometry
