#pragma once

#include "geometry/polygon.hpp"

namespace polynya::geometry {

/// The corners of the convex hull of a ring, counter-clockwise.
Ring convex_hull(const Ring& ring);

}  // namespace polynya::geometry
