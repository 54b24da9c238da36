#pragma once

#include "geometry/contact/crack_path.hpp"

namespace polynya::geometry {

/// Twice the ice on a crack's narrower side, measured across it from a share of its way to the nearest
/// boundary on either side, holes included [m].
double crack_width(const Boundary& boundary, const CrackPath& path, double share_of_way);

}  // namespace polynya::geometry
