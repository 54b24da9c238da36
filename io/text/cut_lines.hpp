#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// A path along which ice is cut, from its first point to its last.
using CutPath = std::vector<geometry::Point>;

/// The straight line through a point, from beyond a box to beyond it. Its reach is a power of two, so that floes about
/// as far from the point share the very same line.
CutPath path_across(geometry::Point point, double angle_deg, const geometry::Box& box);

/// The distance within which ends of paths are continued, if no other is given [m]: 64 units in the last place of the
/// largest coordinate. So a path that was computed to end on another one does, and nothing else changes.
double default_snap(const geometry::Polygon& floe, const std::vector<CutPath>& paths);

/// The paths, with ends continued that lie before the floe's boundary or before another path by at most `snap` [m],
/// measured along the path: just beyond what they then meet. Other ends stay where they are.
std::vector<CutPath> continued(const std::vector<CutPath>& paths, const geometry::Polygon& floe, double snap);

/// Whether an end of one of the paths lies in the box: then whether it separates may depend on the other paths.
bool ends_within(const std::vector<CutPath>& paths, const geometry::Box& box);

}  // namespace polynya::io
