#include "fracture/turning_cusp.hpp"

#include <cmath>
#include <numbers>

namespace polynya::fracture {

double edge_mass(const Ice& ice, const Water& water, const TurningCusp& cusp) {
  if (cusp.area <= 0 || cusp.depth <= 0) return 0;
  const double length_over_width = cusp.depth * cusp.depth / cusp.area;
  const double finite = 1 / std::sqrt(1 + length_over_width * length_over_width);
  constexpr double kPlate = 9 * std::numbers::pi / 256;
  return ice.density * ice.thickness * cusp.second_moment / (cusp.depth * cusp.depth) +
         kPlate * water.density * cusp.area * cusp.depth * finite;
}

}  // namespace polynya::fracture
