#include "simulation/ship/hull_angle.hpp"

#include <limits>

#include "fracture/crushing.hpp"

namespace polynya::simulation {

using geometry::Point;

double hull_angle_at(const Hull& hull, const dynamics::Bodies& bodies, const dynamics::Contact& c) {
  const geometry::Pose pose = dynamics::water_from_body(bodies, c.a);
  if (hull.angles_from_vertical.empty()) {
    return fracture::hull_angle_from_vertical(rotate_back(pose.rotation, c.normal).x, hull.stem_angle);
  }
  const Point here = inverse_transform(pose, c.middle());
  double nearest = std::numeric_limits<double>::infinity();
  double angle = 0;
  for (std::size_t i = 0; i < hull.waterline.size(); ++i) {
    const std::size_t next = (i + 1) % hull.waterline.size();
    const double along = nearest_part(hull.waterline[i], hull.waterline[next], here);
    const double d = squared_length(here - (hull.waterline[i] + along * (hull.waterline[next] - hull.waterline[i])));
    if (d >= nearest) continue;
    nearest = d;
    angle = (1 - along) * hull.angles_from_vertical[i] + along * hull.angles_from_vertical[next];
  }
  return angle;
}

}  // namespace polynya::simulation
