#include "fracture/bending/scaled_load.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "fracture/characteristic_length.hpp"

namespace polynya::fracture {

ScaledLoad scaled(const BendingLoad& load) {
  const Ice& ice = load.ice;
  const double l = characteristic_length(ice, load.water);
  const double h = ice.thickness;
  ScaledLoad result;
  result.length_scale = l;
  result.force_scale = ice.flexural_strength * h * h;
  result.time_scale = std::sqrt(l / kGravity);
  result.groups.opening_angle =
      load.opening_angle > 0 ? load.opening_angle : load.front_half_angle + load.back_half_angle;
  result.groups.mass_ratio = ice.density * h / (load.water.density * l);
  result.groups.froude = std::max(load.mean_approach_speed, 0.0) / std::sqrt(kGravity * l);
  const double tangent_sum = std::tan(load.front_half_angle) + std::tan(load.back_half_angle);
  const double crushing =
      ice.compressive_strength * load.vertical_to_crushing * tangent_sum / (2 * std::sin(load.hull_angle));
  result.groups.softness = crushing > 0 && std::isfinite(crushing) ? result.force_scale / (crushing * l * l)
                                                                   : std::numeric_limits<double>::infinity();
  result.full_depth = h * std::tan(load.hull_angle) / l;
  result.feedback = result.force_scale * std::tan(load.hull_angle) / (load.water.density * kGravity * l * l * l);
  return result;
}

WedgePush push_of(const ScaledLoad& load, Feedback feedback) {
  return {load.groups.froude, load.groups.softness, load.full_depth,
          feedback == Feedback::kCoupled ? load.feedback : 0};
}

}  // namespace polynya::fracture
