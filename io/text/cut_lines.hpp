#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::io {

/// A path of straight segments along which ice is cut, from its first point to its last, in the frame of the floe that
/// is cut [m].
using CutPath = std::vector<geometry::Point>;

/// Returns a straight line through a point that crosses a box completely and ends beyond it on both sides. `angle_deg`
/// is its direction, counter-clockwise from the x axis [°]; multiples of 45° are exact. Its half length is a power of
/// two [m], at least twice as long as necessary. So floes that are about as far from the point get exactly the same
/// line, and their cuts fit together.
CutPath path_across(geometry::Point point, double angle_deg, const geometry::Box& box);

/// Returns the distance within which ends of paths are continued if the user gives none [m]: 64 units in the last place
/// of the largest coordinate of the floe's outer ring and the paths. It is just large enough that a path whose end was
/// computed to lie on a boundary or on another path reaches it in spite of rounding. A larger distance would also close
/// gaps that are intended.
double default_snap(const geometry::Polygon& floe, const std::vector<CutPath>& paths);

/// Returns the paths with their ends extended. If an end would meet the floe's boundary or another path when continued
/// straight by at most `snap` [m], it is moved there and a little further (by default_snap()), so that the cut goes
/// through. If it would meet several, the nearest one counts. All other paths are taken as they were given, not as they
/// are extended here. Other ends stay where they are, and so do both ends of a path that has fewer than two points or
/// points that are not usable (geometry::are_usable). A larger `snap` extends more ends.
std::vector<CutPath> continued(const std::vector<CutPath>& paths, const geometry::Polygon& floe, double snap);

/// Returns true if an end of one of the paths lies in the box or on its edge. Such a path does not cross the box
/// completely, so whether it separates the ice there may depend on the other paths, and the paths must be cut together.
bool ends_within(const std::vector<CutPath>& paths, const geometry::Box& box);

}  // namespace polynya::io
