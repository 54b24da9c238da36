#pragma once

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

/// Whether two bodies share nothing, in plain doubles: no edges cross or touch, and neither is inside the
/// other. A boundary's edges suffice, it need not be ready. Of a's edges only those in the box of b are
/// compared with b's: b is best the smaller. Within rounding of a touch the answer may be either.
bool is_clear(const Boundary& a, const Boundary& b, const Pose& a_from_b);

}  // namespace polynya::geometry
