#pragma once

#include <algorithm>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::fracture {

inline constexpr double kSmallestHalfAngle = 0.174532925199432957;  ///< 10°, least wedge half-angle [rad]
inline constexpr double kLargestHalfAngle = 1.43116998663535025;    ///< 82°: tan diverges at a straight edge [rad]

/// The hull's inclination from the vertical where its waterline's plan normal has the forward component
/// sin α: tan θ_s = sin α / tan φ, with the stem angle φ from the horizontal and the waterline angle α from
/// the centreline [rad]. Aft of midships (sin α < 0) the wall is taken as vertical.
double hull_angle_from_vertical(double sine_waterline_angle, double stem_angle);

/// The overlap of two bodies in plan, as one contact measures it.
struct Overlap {
  double width = 0;  ///< dS/dξ at the waterline: length of the contact line [m]
  double depth = 0;  ///< ξ, penetration along the plan normal [m]
  double area = 0;   ///< S(ξ) [m²]
};

/// Crushed contact area A_c = [S(ξ) − S(ξ − h tan θ_s)] / sin θ_s [m²], at a vertical wall h dS/dξ. The
/// general form of Eq. (2) of [Sawamura2017] for any contact shape; h thickness [m], θ_s hull angle from the
/// vertical [rad], 0 ≤ θ_s < π/2. The overlap's history is taken as the power law of its measures,
/// S(ξ') = S (ξ'/ξ)^p with p = ξ (dS/dξ) / S: a wedge has p = 2 and gives Eq. (2) exactly, a straight edge
/// along the hull p = 1, where Eq. (2)'s tan θ_w would diverge. p is clamped to [1, 3].
double crushed_overlap_area(const Overlap& overlap, double thickness, double hull_angle);

/// A_c of an overlap at a depth of its own, and how it grows there.
struct CrushedArea {
  double area = 0;   ///< A_c [m²]
  double slope = 0;  ///< dA_c/dξ, ≥ 0 [m]
};

/// The same at another depth: S is continued by its power law to `depth` [m], with p between 1/3 and 3, so that at its
/// own depth an overlap grows by its width, though it is wider inside than its contact line.
CrushedArea crushed_overlap_at(const Overlap& overlap, double depth, double thickness, double hull_angle);

/// What crushed of the ice where an overlap reached that area, V = ∫ S(ξ − z tan θ_s) dz over the thickness,
/// dV/dξ = A_c cos θ_s; at a vertical wall h S. S is continued by its power law [m³].
double crushed_volume(const Overlap& overlap, double reached_area, double thickness, double hull_angle);

/// A_c where the ice edge recedes from the hull while it is pressed: of the depth, ξ is crushed and the
/// rest is what the edge has given way, depth = ξ + r A_c(ξ).
struct RecedingCrush {
  double penetration = 0;  ///< ξ [m]
  CrushedArea crushed;     ///< A_c(ξ), and how it grows with the depth (not with ξ)
  double share = 1;        ///< dξ/d depth [-]
};

/// `recession` r ≥ 0 [m/m²], at 0 that of crushed_overlap_at. r must not change while A_c grows: where it
/// does, the slope is that with r held.
RecedingCrush crushed_receding(const Overlap& overlap, double depth, double thickness, double hull_angle,
                               double recession);

/// The forces between hull and ice while it crushes, per newton of the facet's normal force F_n.
struct CrushingShares {
  double horizontal = 1;  ///< H / F_n along the plan normal
  double vertical = 0;    ///< V / F_n, down on the ice; ≤ 0 where the hull is too steep to bend the ice
  double tangential = 0;  ///< most that friction may carry along the hull, / F_n
};

/// H = F_n (cos θ_s + μ sin θ_s), V = F_n (sin θ_s − μ cos θ_s · s), s = v_n sin θ_s / √(v_n² sin² θ_s +
/// v_t²); what is left of μ F_n acts along the hull, μ F_n √(1 − s²). Eqs. (1), (3) of [Sawamura2017] on the
/// inclined facet. approach_speed v_n and slip_speed v_t along the hull [m/s]. Deviation: at θ_s = 0 all
/// friction is tangential, as for any vertical wall.
CrushingShares crushing_shares(double hull_angle, double friction, double approach_speed, double slip_speed);

/// A stretch of a hull's side in a contact that bends around it, in the contact's frame: x along its normal, y along
/// its line.
struct HullFacet {
  double length = 0;        ///< along the waterline [m]
  geometry::Vector normal;  ///< in plan, out of the hull; unit
  double angle = 0;         ///< θ_i, from the vertical [rad]
};

/// The shares of a contact with several facets, as about a stem, which ice slides along in directions of their own:
///
///   V = F_n sin θ_s (1 − μ Σ a_i u_i cos θ_i / |t_i|),   t_i² = v² − (u_i cos θ_i)²,
///
/// with v the speed of the hull against the ice, u_i its part along a facet's normal in plan and a_i ∝ L_i ⟨u_i⟩ the
/// facet's share of the overlap that the motion makes. H is that of crushing_shares, which has the whole of μ F_n down
/// the slope; along the line acts what friction leaves there of all facets. Of one facet that is crushing_shares.
/// `velocity` is that of the hull against the ice in the contact's frame [m/s]. Own law.
CrushingShares crushing_shares_around(std::span<const HullFacet> facets, double hull_angle, double friction,
                                      geometry::Vector velocity);

/// F_n = σ_c A_c [N]. Eq. (1) of [Sawamura2017].
inline double crushing_force(const Ice& ice, double area) {
  return ice.compressive_strength * area;
}

/// What crushes where two floes meet: the weaker ice, as high as the thinner floe, which is all that touches.
inline Ice crushed_between(const Ice& a, const Ice& b) {
  Ice ice = b.thickness < a.thickness ? b : a;
  ice.compressive_strength = std::min(a.compressive_strength, b.compressive_strength);
  return ice;
}

}  // namespace polynya::fracture
