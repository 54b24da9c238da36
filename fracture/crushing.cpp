#include "fracture/crushing.hpp"

#include <algorithm>

namespace polynya::fracture {

double hull_angle_from_vertical(double sine_waterline_angle, double stem_angle) {
  return std::atan(std::max(0.0, sine_waterline_angle) / std::tan(stem_angle));
}

double crushed_area(double tangent_sum, double penetration, double thickness, double hull_angle) {
  if (penetration <= 0) return 0;
  const double reach = thickness * std::tan(hull_angle);  // the facet spans the whole thickness from here on
  // (ξ² − (ξ − r)²) / 2 sin θ = r (2ξ − r) / 2 sin θ with r = h tan θ: no cancellation, no division by zero.
  if (penetration >= reach) {
    return tangent_sum * thickness * (2 * penetration - reach) / (2 * std::cos(hull_angle));
  }
  return tangent_sum * penetration * penetration / (2 * std::sin(hull_angle));
}

CrushingShares crushing_shares(double hull_angle, double friction, double approach_speed, double slip_speed) {
  const double sine = std::sin(hull_angle);
  const double cosine = std::cos(hull_angle);
  const double down_slip = std::max(0.0, approach_speed) * sine;
  const double slip = std::hypot(down_slip, slip_speed);
  const double down_share = slip > 0 ? down_slip / slip : 1.0;
  CrushingShares shares;
  shares.horizontal = cosine + friction * sine;
  shares.vertical = sine - friction * cosine * down_share;
  shares.tangential = sine > 0 ? friction * std::sqrt(std::max(0.0, 1 - down_share * down_share)) : friction;
  return shares;
}

}  // namespace polynya::fracture
