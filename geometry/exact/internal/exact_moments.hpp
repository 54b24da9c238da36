#pragma once

#include "geometry/exact/measures.hpp"

namespace polynya::geometry {

/// Measures of a valid polygon computed in rationals and rounded once: for slivers, whose moments in doubles
/// are noise.
Measures exact_measures(const Polygon& polygon);

}  // namespace polynya::geometry
