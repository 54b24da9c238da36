#include "fracture/crushing.hpp"

#include <algorithm>
#include <cmath>

#include "elementary/elementary.hpp"

namespace polynya::fracture {
namespace {

/// Hull angles from the vertical whose sine is smaller count as 0, because quotients would overflow [-].
constexpr double kVertical = 1e-100;

/// Returns p of the power law of an overlap, S(ξ') = S (ξ'/ξ)^p [-]. Values outside of the limits belong to shapes that
/// one depth and one width do not describe.
double power_of(const Overlap& overlap, double least = 1.0 / 3) {
  return std::clamp(overlap.depth * overlap.width / overlap.area, least, 3.0);
}

}  // namespace

double hull_angle_from_vertical(double sine_waterline_angle, double stem_angle) {
  return elementary::atan(std::max(0.0, sine_waterline_angle) / elementary::tan(stem_angle));
}

double crushed_overlap_area(const Overlap& overlap, double thickness, double hull_angle) {
  if (overlap.area <= 0 || overlap.depth <= 0) return 0;
  const double p = power_of(overlap, 1);
  const double reach = thickness * elementary::tan(hull_angle);
  const double sine = elementary::sin(hull_angle);
  if (sine < kVertical) return overlap.area * p / overlap.depth * thickness;
  if (reach >= overlap.depth) return overlap.area / sine;
  return overlap.area / sine * -elementary::expm1(p * elementary::log1p(-reach / overlap.depth));
}

namespace {

/// The sine and tangent of a hull's inclination from the vertical.
struct HullSlant {
  double sine, tangent;
  explicit HullSlant(double angle)
      : sine(angle == 0 ? 0 : elementary::sin(angle)), tangent(angle == 0 ? 0 : elementary::tan(angle)) {}
};

CrushedArea crushed_at(const Overlap& overlap, double depth, double thickness, const HullSlant& hull) {
  if (overlap.area <= 0 || overlap.depth <= 0 || depth <= 0) return {};
  const double p = power_of(overlap);
  const bool is_its_own = depth == overlap.depth;  // no power is needed for most contacts that crush
  const double area = is_its_own ? overlap.area : overlap.area * elementary::pow(depth / overlap.depth, p);
  const double slope = p * area / depth;
  if (hull.sine < kVertical) return {thickness * slope, std::max(0.0, thickness * (p - 1) * slope / depth)};
  // Differences of powers by expm1, because a hull that is vertical except for rounding has an angle of 1e-17 rad.
  const double reach = thickness * hull.tangent / depth;
  const double log_of_inner = reach < 1 ? elementary::log1p(-reach) : 0;
  const double pressed = reach < 1 ? -elementary::expm1(p * log_of_inner) : 1;
  const double growing = reach < 1 ? -elementary::expm1((p - 1) * log_of_inner) : 1;
  return {area * pressed / hull.sine, std::max(0.0, slope * growing / hull.sine)};
}

}  // namespace

CrushedArea crushed_overlap_at(const Overlap& overlap, double depth, double thickness, double hull_angle) {
  return crushed_at(overlap, depth, thickness, HullSlant(hull_angle));
}

double crushed_volume(const Overlap& overlap, double reached_area, double thickness, double hull_angle) {
  if (overlap.area <= 0 || overlap.depth <= 0 || reached_area <= 0) return 0;
  if (hull_angle == 0) return thickness * reached_area;  // most contacts are between floes
  const double p = power_of(overlap);
  const double depth = overlap.depth * elementary::pow(reached_area / overlap.area, 1 / p);
  const double reach = thickness * elementary::tan(hull_angle) / depth;
  if (reach < kVertical) return thickness * reached_area;
  const double left = reach < 1 ? -elementary::expm1((p + 1) * elementary::log1p(-reach)) : 1;
  return thickness * reached_area * left / ((p + 1) * reach);
}

RecedingCrush crushed_receding(const Overlap& overlap, double depth, double thickness, double hull_angle,
                               double recession) {
  const HullSlant hull(hull_angle);
  RecedingCrush result{depth, crushed_at(overlap, depth, thickness, hull)};
  if (recession <= 0 || depth <= 0) return result;
  // ξ + r A_c(ξ) grows with ξ, and is convex except where the facet reaches the full thickness: Newton's method
  // within a bracket.
  constexpr int kMostTries = 60;        // bisection alone reaches the last bit in 53
  constexpr double kTolerance = 1e-12;  // of the depth; coarser: the law's force jumps between two depths
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
  const double sine = elementary::sin(hull_angle);
  const double cosine = elementary::cos(hull_angle);
  const double down_slip = std::max(0.0, approach_speed) * sine;
  const double slip = elementary::hypot(down_slip, slip_speed);
  const double down_share = slip > 0 ? down_slip / slip : 1.0;
  CrushingShares shares;
  shares.horizontal = cosine + friction * sine;
  shares.vertical = sine - friction * cosine * down_share;
  shares.tangential = sine > 0 ? friction * std::sqrt(std::max(0.0, 1 - down_share * down_share)) : friction;
  return shares;
}

CrushingShares crushing_shares_around(std::span<const HullFacet> facets, double hull_angle, double friction,
                                      geometry::Vector velocity) {
  CrushingShares shares = crushing_shares(hull_angle, friction, velocity.x, velocity.y);
  double swept = 0, pressed = 0;  // Σ L_i ⟨u_i⟩, and the width, across the normal, of the facets that press
  double down = 0, along = 0;
  for (const HullFacet& facet : facets) {
    const double approach = dot(velocity, facet.normal);
    if (approach <= 0) continue;
    const double cosine = elementary::cos(facet.angle);
    const geometry::Vector slip = velocity - approach * cosine * cosine * facet.normal;
    const double speed = elementary::hypot(length(slip), approach * cosine * elementary::sin(facet.angle));
    const double share = speed > 0 ? approach * cosine / speed : 0;
    swept += facet.length * approach;
    pressed += facet.length * facet.normal.x;
    down += facet.length * approach * share;
    along += speed > 0 ? facet.length / cosine * slip.y / speed : 0;
  }
  const double sine = elementary::sin(hull_angle);
  if (swept <= 0 || pressed <= 0 || sine == 0) return shares;
  shares.vertical = sine * (1 - friction * down / swept);
  shares.tangential = friction * std::min(1.0, std::abs(along) * elementary::cos(hull_angle) / pressed);
  return shares;
}

}  // namespace polynya::fracture
