#include "geometry/contact/crack_width.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/contact/line_crossings.hpp"

namespace polynya::geometry {

double crack_width(const Boundary& boundary, const CrackPath& path, double share_of_way) {
  const Vector way = path.end - path.start;
  const Vector across = perpendicular(way) / length(way);
  double nearest = std::numeric_limits<double>::infinity();
  for (const LineCrossing& crossing : crossings_of_line(boundary, path.start + share_of_way * way, across))
    nearest = std::min(nearest, std::abs(crossing.at));
  return std::isfinite(nearest) ? 2 * nearest : 0;
}

}  // namespace polynya::geometry
