#include "fracture/crushing.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::fracture {
namespace {

/// A hull angle from the vertical whose sine would overflow a quotient is taken as 0 [-].
constexpr double kVertical = 1e-100;

}  // namespace

double hull_angle_from_vertical(double sine_waterline_angle, double stem_angle) {
  return std::atan(std::max(0.0, sine_waterline_angle) / std::tan(stem_angle));
}

double crushed_overlap_area(const Overlap& overlap, double thickness, double hull_angle) {
  if (overlap.area <= 0 || overlap.depth <= 0) return 0;
  const double p = std::clamp(overlap.depth * overlap.width / overlap.area, 1.0, 3.0);
  const double reach = thickness * std::tan(hull_angle);
  const double sine = std::sin(hull_angle);
  if (sine < kVertical) return overlap.area * p / overlap.depth * thickness;
  if (reach >= overlap.depth) return overlap.area / sine;
  return overlap.area / sine * -std::expm1(p * std::log1p(-reach / overlap.depth));
}

namespace {

/// A hull's inclination from the vertical.
struct HullSlant {
  double sine, tangent;
  explicit HullSlant(double angle)
      : sine(angle == 0 ? 0 : std::sin(angle)), tangent(angle == 0 ? 0 : std::tan(angle)) {}
};

CrushedArea crushed_at(const Overlap& overlap, double depth, double thickness, const HullSlant& hull) {
  if (overlap.area <= 0 || overlap.depth <= 0) return {};
  const double p = std::clamp(overlap.depth * overlap.width / overlap.area, 1.0, 3.0);
  const auto area_at = [&](double x) {
    if (x == overlap.depth) return overlap.area;  // without a power: most contacts that crush
    return x > 0 ? overlap.area * std::pow(x / overlap.depth, p) : 0.0;
  };
  const auto slope_at = [&](double x, double area) { return x > 0 ? p * area / x : 0.0; };
  const double area = area_at(depth);
  const double slope = slope_at(depth, area);
  if (hull.sine < kVertical) return {thickness * slope, thickness * (p - 1) * slope / depth};
  const double inner = depth - thickness * hull.tangent;
  const double inner_area = area_at(inner);
  return {(area - inner_area) / hull.sine, std::max(0.0, slope - slope_at(inner, inner_area)) / hull.sine};
}

}  // namespace

CrushedArea crushed_overlap_at(const Overlap& overlap, double depth, double thickness, double hull_angle) {
  return crushed_at(overlap, depth, thickness, HullSlant(hull_angle));
}

double crushed_volume(const Overlap& overlap, double reached_area, double thickness, double hull_angle) {
  if (overlap.area <= 0 || overlap.depth <= 0 || reached_area <= 0) return 0;
  if (hull_angle == 0) return thickness * reached_area;  // between floes: most contacts
  const double p = std::clamp(overlap.depth * overlap.width / overlap.area, 1.0, 3.0);
  const double depth = overlap.depth * std::pow(reached_area / overlap.area, 1 / p);
  const double reach = thickness * std::tan(hull_angle) / depth;
  if (reach < kVertical) return thickness * reached_area;
  const double left = reach < 1 ? -std::expm1((p + 1) * std::log1p(-reach)) : 1;
  return thickness * reached_area * left / ((p + 1) * reach);
}

RecedingCrush crushed_receding(const Overlap& overlap, double depth, double thickness, double hull_angle,
                               double recession) {
  const HullSlant hull(hull_angle);
  RecedingCrush result{depth, crushed_at(overlap, depth, thickness, hull)};
  if (recession <= 0 || depth <= 0) return result;
  // ξ + r A_c(ξ) grows, and is convex but where the facet comes to span the thickness: Newton's method,
  // within a bracket.
  constexpr int kMostTries = 60;        // bisection alone comes to the last bit in 53
  constexpr double kTolerance = 1e-12;  // of the depth: coarser, and the law's force steps between two depths
  double shallow = 0, deep = depth;
  for (int i = 0; i < kMostTries; ++i) {
    const double excess = result.penetration + recession * result.crushed.area - depth;
    (excess > 0 ? deep : shallow) = result.penetration;
    if (std::abs(excess) <= kTolerance * depth || deep - shallow <= kTolerance * depth) break;
    const double next = result.penetration - excess / (1 + recession * result.crushed.slope);
    result.penetration = next > shallow && next < deep ? next : 0.5 * (shallow + deep);
    result.crushed = crushed_at(overlap, result.penetration, thickness, hull);
  }
  const double growth = 1 + recession * result.crushed.slope;
  result.share = 1 / growth;
  result.crushed.slope /= growth;
  return result;
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
