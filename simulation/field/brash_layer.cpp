#include "simulation/field/brash_layer.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace polynya::simulation {

double BrashLayer::thickness_at(double distance) const {
  const double share = std::clamp(distance / (0.5 * width), 0.0, 1.0);
  return thickness + share * (side_thickness - thickness);
}

double consolidated_density(const BrashLayer& brash, double thickness, const fracture::Ice& ice,
                            const fracture::Water& water) {
  return water.density - (water.density - ice.density) * (1 + brash.mean_ice() / thickness);
}

double distance_to_line(geometry::Point point, const std::vector<geometry::Point>& line) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 1; i < line.size(); ++i)
    least = std::min(least, distance_to_segment(point, line[i - 1], line[i]));
  return least;
}

}  // namespace polynya::simulation
