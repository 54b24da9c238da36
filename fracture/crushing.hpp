#pragma once

#include <algorithm>
#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::fracture {

inline constexpr double kSmallestHalfAngle = 0.174532925199432957;  ///< 10°, smallest half-angle of a wedge [rad]
inline constexpr double kLargestHalfAngle =
    1.43116998663535025;  ///< 82°, largest half-angle of a wedge: its tangent diverges at a straight edge [rad]

/// Returns the hull's inclination from the vertical at a place where the plan normal of its waterline has the forward
/// component sin α: tan θ_s = sin α / tan φ, with the stem angle φ from the horizontal and the waterline angle α from
/// the centreline [rad]. Aft of midships (sin α < 0) the wall is taken as vertical.
double hull_angle_from_vertical(double sine_waterline_angle, double stem_angle);

/// The overlap of two bodies in plan, as measured at one contact.
struct Overlap {
  double width = 0;  ///< dS/dξ at the waterline: length of the contact line [m]
  double depth = 0;  ///< ξ, penetration along the plan normal [m]
  double area = 0;   ///< S(ξ) [m²]
};

/// Returns the crushed contact area A_c = [S(ξ) − S(ξ − h tan θ_s)] / sin θ_s, or h dS/dξ at a vertical wall [m²]. This
/// is the general form of Eq. (2) of [Sawamura2017] for any shape of contact; h is the thickness [m] and θ_s the hull's
/// angle from the vertical [rad], 0 ≤ θ_s < π/2. The overlap at smaller depths follows the power law of its measures,
/// S(ξ') = S (ξ'/ξ)^p with p = ξ (dS/dξ) / S, limited to [1, 3]. A wedge has p = 2 and gives Eq. (2) exactly. A
/// straight edge along the hull has p = 1, where tan θ_w in Eq. (2) would diverge.
double crushed_overlap_area(const Overlap& overlap, double thickness, double hull_angle);

/// The crushed area A_c of an overlap at a given depth, and its growth with the depth.
struct CrushedArea {
  double area = 0;   ///< A_c [m²]
  double slope = 0;  ///< dA_c/dξ, ≥ 0 [m]
};

/// Returns the crushed area at another depth: S is continued by its power law to `depth` [m], with p between 1/3 and 3.
/// At its own depth an overlap then grows by its width, even if it is wider inside than along its contact line.
CrushedArea crushed_overlap_at(const Overlap& overlap, double depth, double thickness, double hull_angle);

/// Returns the volume of ice that has crushed when an overlap reaches this area [m³]: V = ∫ S(ξ − z tan θ_s) dz over
/// the thickness, dV/dξ = A_c cos θ_s; h S at a vertical wall. S is continued by its power law.
double crushed_volume(const Overlap& overlap, double reached_area, double thickness, double hull_angle);

/// The crushed area where the ice edge recedes from the hull while it is pressed. The depth is the sum of the crushed
/// penetration ξ and the recession of the edge: depth = ξ + r A_c(ξ).
struct RecedingCrush {
  double penetration = 0;  ///< ξ [m]
  CrushedArea crushed;     ///< A_c(ξ), and its growth with the depth (not with ξ)
  double share = 1;        ///< dξ/d depth [-]
};

/// Returns the crushed area for a recession r ≥ 0 per crushed area [m/m²]; with r = 0 it equals crushed_overlap_at. r
/// must not change while A_c grows; if it does, the slope is the one for constant r.
RecedingCrush crushed_receding(const Overlap& overlap, double depth, double thickness, double hull_angle,
                               double recession);

/// The forces between hull and ice while ice crushes, divided by the normal force F_n on the facet.
struct CrushingShares {
  double horizontal = 1;  ///< H / F_n along the plan normal
  double vertical = 0;    ///< V / F_n, down on the ice; ≤ 0 if the hull is too steep to bend the ice
  double tangential = 0;  ///< largest friction along the hull over F_n
};

/// Returns the shares of a single facet: H = F_n (cos θ_s + μ sin θ_s), V = F_n (sin θ_s − μ s cos θ_s) with s = v_n
/// sin θ_s / √(v_n² sin² θ_s + v_t²). The rest of μ F_n acts along the hull, μ F_n √(1 − s²). Eqs. (1), (3) of
/// [Sawamura2017] on the inclined facet. approach_speed is v_n and slip_speed is v_t along the hull [m/s]. Deviation:
/// at θ_s = 0 all friction is tangential, as for any vertical wall.
CrushingShares crushing_shares(double hull_angle, double friction, double approach_speed, double slip_speed);

/// A stretch of a hull's side in a contact that bends around the hull, in the contact's frame: x along its normal, y
/// along its line.
struct HullFacet {
  double length = 0;        ///< along the waterline [m]
  geometry::Vector normal;  ///< in plan, out of the hull; unit
  double angle = 0;         ///< θ_i, from the vertical [rad]
};

/// Returns the shares of a contact with several facets, as about a stem, where the ice slides along each facet in its
/// own direction:
///
///   V = F_n sin θ_s (1 − μ Σ a_i u_i cos θ_i / |t_i|),   t_i² = v² − (u_i cos θ_i)²,
///
/// with the speed v of the hull relative to the ice, its component u_i along the normal of facet i in plan, and the
/// share a_i ∝ L_i ⟨u_i⟩ of facet i in the overlap that the motion makes. H is the one of crushing_shares, which has
/// all of μ F_n down the slope. Along the line acts the friction that remains there from all facets. For a single facet
/// the result is crushing_shares. `velocity` is the velocity of the hull relative to the ice, in the contact's frame
/// [m/s]. Own law.
CrushingShares crushing_shares_around(std::span<const HullFacet> facets, double hull_angle, double friction,
                                      geometry::Vector velocity);

/// Returns the crushing force F_n = σ_c A_c [N]. Eq. (1) of [Sawamura2017].
inline double crushing_force(const Ice& ice, double area) {
  return ice.compressive_strength * area;
}

/// Returns the ice that crushes between two floes: the properties of the weaker ice, with the height of the thinner
/// floe, over which they touch.
inline Ice crushed_between(const Ice& a, const Ice& b) {
  Ice ice = b.thickness < a.thickness ? b : a;
  ice.compressive_strength = std::min(a.compressive_strength, b.compressive_strength);
  return ice;
}

}  // namespace polynya::fracture
