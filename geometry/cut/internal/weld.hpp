#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The polygon without what rounding can leave in a ring and encloses nothing: equal neighbours and spikes,
/// edges folded back on the one before. Rings that enclose nothing at all are dropped; an outer one leaves an
/// empty ring.
Polygon welded(const Polygon& polygon);

}  // namespace polynya::geometry
