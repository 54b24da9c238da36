#include "fracture/bending/kashtelyan.hpp"

#include <algorithm>
#include <numbers>

#include "fracture/characteristic_length.hpp"

namespace polynya::fracture {

double kashtelyan_force(double opening_angle, const Ice& ice, const KashtelyanCoefficients& coefficients) {
  const double share = opening_angle / std::numbers::pi;
  return coefficients.force * share * share * ice.flexural_strength * ice.thickness * ice.thickness;
}

double kashtelyan_radius(double characteristic_length, double approach_speed,
                         const KashtelyanCoefficients& coefficients) {
  const double factor = 1 + coefficients.radius_speed * approach_speed;
  return coefficients.radius * characteristic_length * std::max(factor, kSmallestKashtelyanRadiusFactor);
}

BendingCapacity KashtelyanModel::capacity(const BendingLoad& load) const {
  BendingCapacity result;
  result.vertical_force =
      kashtelyan_force(load.front_half_angle + load.back_half_angle, load.ice, coefficients_);
  result.cusp_radius =
      kashtelyan_radius(characteristic_length(load.ice, load.water), load.mean_approach_speed, coefficients_);
  result.is_in_range =
      1 + coefficients_.radius_speed * load.mean_approach_speed >= kSmallestKashtelyanRadiusFactor;
  return result;
}

}  // namespace polynya::fracture
