#pragma once

#include <span>

#include "fracture/materials.hpp"
#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::fracture {

// A slender floe breaks across as a beam, free in the water and under the forces on its edge (docs/theory/beams.md):
// what those forces do to a part of it, less what moves that part, bends the section where the part ends. Lengths are
// in a frame whose origin is the floe's centre of mass, with x along its length.

/// From this ratio of length to width on a floe is a beam: below, plane sections do not stay plane [-].
inline constexpr double kLeastSlenderness = 4;

/// Of the mean width: a narrower section is the floe's tip [-].
inline constexpr double kLeastSection = 0.5;

/// Whether a floe is as slender as a rectangle of that ratio, by its area [m²] and its polar radius of
/// gyration squared [m²].
constexpr bool is_beam(double area, double gyration_squared) {
  return 12 * gyration_squared >= (kLeastSlenderness + 1 / kLeastSlenderness) * area;
}

/// ∫ 1, x, y, x², xy, y² dA of a part of a floe.
struct PlaneMoments {
  double area = 0;
  double x = 0, y = 0;
  double xx = 0, xy = 0, yy = 0;
};

/// Of a polygon, as it lies in the frame that `frame_from_body` leads to.
PlaneMoments moments_of(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body);

/// Of the part of it at x ≤ `x` [m].
PlaneMoments moments_up_to(const geometry::Polygon& polygon, const geometry::Pose& frame_from_body, double x);

/// The angle of the axis along which a region is longest, by its moments about its centre [rad].
double long_axis(const PlaneMoments& about_centre);

/// A force on the edge of a floe.
struct BeamLoad {
  geometry::Point at;      ///< [m]
  geometry::Vector force;  ///< in plan [N]
  double down = 0;         ///< that presses the floe down there [N]
};

/// A section across a floe, along y.
struct BeamSection {
  double x = 0;       ///< [m]
  double middle = 0;  ///< its y [m]
  double width = 0;   ///< [m]
};

/// What a section carries.
struct SectionLoad {
  double tension = 0;          ///< N along the floe [N]
  double moment = 0;           ///< M in plan; > 0: it pulls at the greater y [N m]
  double vertical_moment = 0;  ///< M_v by what presses the floe down, rigid on the water [N m]
};

/// Newton's law of the part of the floe before the section: in plan its share of the inertia of a rigid body
/// answers the loads, and below it water that lifts in proportion to heave and pitch.
SectionLoad section_load(std::span<const BeamLoad> loads, const PlaneMoments& floe, const PlaneMoments& before,
                         const BeamSection& section);

/// M_v of an elastic beam of that length [m] pressed down at its middle, over V Λ/8 of a rigid one:
/// 2 (cosh b − cos b)/(b (sinh b + sin b)), b = Λ (ρ_w g/(4 E h³/12))^¼. After [Hetenyi1946] (*recall*).
double elastic_share(const Ice& ice, const Water& water, double length);

/// The greatest tension at a corner of the section, N/(h w) + 6 |M|/(h w²) + 6 |M_v|/(w h²) [Pa].
double section_stress(const Ice& ice, double width, const SectionLoad& load);

/// No section of a floe of that length, at least so wide [m], has a greater stress by forces of that sum and
/// weight [N]: no load bends a free beam by more than ¼ F Λ [Pa].
double most_section_stress(const Ice& ice, double least_width, double length, double force, double down);

}  // namespace polynya::fracture
