#pragma once

#include <array>
#include <cstddef>

#include "geometry/contact/crack_path.hpp"

namespace polynya::fracture {

/// Number of circles about the point of first touch on which the width of the ice is measured. The radii are evenly
/// spaced in ln r. More circles resolve the outline of the ice better and cost time in proportion.
inline constexpr std::size_t kSectionCount = 12;
/// Ratio of the radius of a circle to the one before [-]. kTurnReach (edge_sections.cpp) counts these circles, so
/// another ratio changes the stresses of cracked edges.
inline constexpr double kSectionStep = 1.25;

/// Radii of the circles divided by the characteristic length, r / l [-], from 0.08 to 0.93.
inline constexpr std::array<double, kSectionCount> kSectionRadii = [] {
  std::array<double, kSectionCount> radii{0.08};
  for (std::size_t i = 1; i < kSectionCount; ++i) radii[i] = kSectionStep * radii[i - 1];
  return radii;
}();

/// Outline of an edge of ice. For each circle: the angles from the hull's inward normal to the places at which the
/// boundary of the ice first leaves the circle, to the front and to the back [rad].
using EdgeOpenings = std::array<geometry::WedgeAngles, kSectionCount>;

/// Load of a hull on an edge of ice. All lengths are divided by the thickness h.
struct EdgeLoad {
  double length = 0;  ///< l / h
  /// λ / h: length over which the load is supported; l / h at rest, shorter if the inertia of ice and water supports
  /// the edge.
  double effective_length = 0;
  double distance = 0;  ///< x̄ / h: distance of the load from the point of first touch
  double thrust = 0;    ///< η = H / V: horizontal force into the ice / downward force [-]
  double lever = 0;     ///< e / h: height of the thrust above the middle plane of the ice
  /// Distance from the point of first touch to the far end of the crushed facet; a cracked edge breaks beyond it.
  double facet = 0;
};

/// The force at which an edge breaks, and the section at which it does.
struct SectionBreak {
  double force = 0;     ///< V_b / (σ_f h²); infinite if the thrust keeps every section under compression
  double distance = 0;  ///< R / h: distance of the section from the point of first touch
};

/// Returns the bending moment in a section of a narrow floating wedge, (ρ w'')'' + ρ w = 0, at a distance ρ from the
/// tip in units of λ: under a unit force on the tip (in units of λ), and under a unit moment there. The values are
/// tabulated up to 4 λ and constant beyond.
double moment_of_force(double distance);
double moment_of_moment(double distance);

/// Returns the factor by which an edge without radial cracks carries more than the bending of its sections alone [-],
/// because the ice also bends across the sections. `opening` is the angle of the section that breaks [rad]. The factor
/// was found with three-dimensional finite elements of wedges (docs/theory/bow.md).
double whole_edge_factor(double opening);

/// Finds the section at which an edge breaks, and the force at which it does (docs/theory/bow.md, "Where an edge
/// breaks").
///
/// If the edge has no radial crack, the stress in the top fibre of a section of width w is
///   σ h² / V = {6 [λ m_V(r/λ) − (x̄ + η e) m_M(r/λ)] − η} h / (f w),
/// with λ, x̄ and e in units of h, w = θ r for the opening θ [rad] of the section on the circle of radius r,
/// and f = whole_edge_factor(θ). The terms are: bending under V; the lever of the thrust, which bends the edge up; and
/// compression by the thrust. The edge breaks off where the stress is largest. That is the narrowest section that is
/// far enough from the load.
///
/// If a radial crack has opened in the bottom of the ice, the stress is largest at the two ends (rims) of a section:
///   σ h² / V = {6 [A (λ m_V − x̄ m_M) − 0.31 η e m_M] − 0.93 η} h / w,
///   A = 0.87 + 0.18 (l/(15 h) − 1) − 0.04 (θ − 2) + 0.19 |Δφ|,
/// where Δφ [rad] is the change of direction of the section's middle up to 1.56 r. In A, l/h, θ and Δφ are limited to
/// the range of the finite elements. Sections within h of the crushed facet do not count. This stress changes little
/// with r. Therefore R is the mean place of the break for ice whose strength scatters by 0.2 from section to section.
/// Such an edge carries at most V / (σ_f h²) = 0.585 (1 + ⟨θ − π⟩), with the widest opening θ within 0.5 l and the
/// positive part ⟨·⟩, because the next radial cracks open at that force. An edge counts as cracked if that opening is
/// 105° or more, and as whole up to 90°; between, the stresses are interpolated.
///
/// Compared with finite elements of 120 other edges, V deviates by at most 11 % and R by at most 23 % (90th
/// percentiles) in the range l/h 10 to 21 and η 1.3 to 3.9. At the stem, which is outside of that range, V is 0.57 to
/// 0.82 and R 0.84 to 1.46 times the values of the elements.
SectionBreak weakest_section(const EdgeOpenings& openings, const EdgeLoad& load);

}  // namespace polynya::fracture
