#pragma once

#include <optional>

#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::io {

/// The ring with vertices left out such that it winds around every point of the box as before. A run of
/// vertices that all lie beyond one side of the box may be drawn straight without passing over it. Elsewhere
/// the result may cross itself. Few vertices are left of a long ring beside a small box.
geometry::Ring near_part(const geometry::Ring& ring, const geometry::Box& box);

/// The area two placed polygons share, exact to the nearest double [m²]: geometry::overlap of the near part
/// of the longer one and all of the other. Nothing where geometry fails.
std::optional<double> shared_area(const geometry::Polygon& a, const geometry::Pose& world_from_a,
                                  const geometry::Polygon& b, const geometry::Pose& world_from_b);

}  // namespace polynya::io
