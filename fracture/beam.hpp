#pragma once

#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::fracture {

// A slender floe breaks across as a beam. It floats freely under the forces on its edge (docs/theory/beams.md). In the
// section where a part of the floe ends, the moment balances the forces on the part and the part's inertia.
// Lengths are in a frame whose origin is the floe's centre of mass, with x along the length of the floe.

/// Smallest ratio of length to width at which a floe counts as a beam [-]. Smaller: plane sections would not stay
/// plane.
inline constexpr double kLeastSlenderness = 4;

/// Smallest width of a section that is checked, as a fraction of the floe's mean width [-], which is its area over the
/// diameter of its bounding circle. Narrower sections are the tips of the floe. A larger fraction may miss the waist at
/// which a floe breaks.
inline constexpr double kLeastSection = 0.5;

/// Returns true if a floe is at least as slender as a rectangle of that ratio, judged by its area [m²] and its polar
/// radius of gyration squared [m²].
constexpr bool is_beam(double area, double gyration_squared) {
  return 12 * gyration_squared >= (kLeastSlenderness + 1 / kLeastSlenderness) * area;
}

/// The integrals ∫ 1, x, y, x², xy, y² dA over a part of a floe.
struct PlaneMoments {
  double area = 0;
  double x = 0, y = 0;
  double xx = 0, xy = 0, yy = 0;
};

/// Returns the moments of a polygon in the frame to which `frame_from_body` leads.
PlaneMoments moments_of(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body);

/// Returns the moments of the part of a polygon at x ≤ `x` [m].
PlaneMoments moments_up_to(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body, double x);

/// Returns the angle of the axis along which a region is longest, from its moments about its centre [rad].
double long_axis(const PlaneMoments& about_centre);

/// A force on the edge of a floe.
struct BeamLoad {
  geometry::Point at;      ///< [m]
  geometry::Vector force;  ///< in plan [N]
  double down = 0;         ///< vertical force that presses the floe down there [N]
};

/// A section across a floe, along y.
struct BeamSection {
  double x = 0;       ///< [m]
  double middle = 0;  ///< y of its middle [m]
  double width = 0;   ///< [m]
};

/// The forces and moments in a section.
struct SectionLoad {
  double tension = 0;  ///< N along the floe [N]
  double moment = 0;   ///< M in plan; positive: tension at the larger y [N m]
  /// M_v by the forces that press the floe down, for a floe that is rigid on the water [N m]. The caller multiplies it
  /// by elastic_share().
  double vertical_moment = 0;
};

/// Returns the load of a section by Newton's law for the part of the floe before it. In plan the loads are balanced by
/// the inertia of the part, which moves with the rigid floe. Vertically they are balanced by the lift of the water,
/// which is proportional to heave and pitch.
SectionLoad section_load(std::span<const BeamLoad> loads, const PlaneMoments& floe, const PlaneMoments& before,
                         const BeamSection& section);

/// Returns the ratio of M_v of an elastic beam of this length [m], pressed down at its middle, to V Λ/8 of a rigid one:
/// 2 (cosh b − cos b)/(b (sinh b + sin b)) with b = Λ (ρ_w g/(4 E h³/12))^¼. [Hetenyi1946] (*recall*).
double elastic_share(const Ice& ice, const Water& water, double length);

/// Returns the largest tensile stress at a corner of the section, N/(h w) + 6 |M|/(h w²) + 6 |M_v|/(w h²) [Pa].
double section_stress(const Ice& ice, double width, const SectionLoad& load);

/// Returns an upper bound of the stress [Pa] in any section of a floe with this length Λ and at least this width [m],
/// for horizontal and vertical forces with these sums F [N]: the moment in a free beam is at most ¼ F Λ [N m].
double most_section_stress(const Ice& ice, double least_width, double length, double force, double down);

}  // namespace polynya::fracture
