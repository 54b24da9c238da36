#pragma once

#include <array>
#include <cstddef>

#include "geometry/contact/crack_path.hpp"

namespace polynya::fracture {

/// Number of circles about the first touch on which the ice beside a contact is measured; evenly spaced in ln r.
inline constexpr std::size_t kSectionCount = 12;
inline constexpr double kSectionStep = 1.25;  ///< ratio of one r to the one before [-]

/// Radii r / l of the sections.
inline constexpr std::array<double, kSectionCount> kSectionRadii = [] {
  std::array<double, kSectionCount> radii{0.08};
  for (std::size_t i = 1; i < kSectionCount; ++i) radii[i] = kSectionStep * radii[i - 1];
  return radii;
}();

/// The true outline of an edge of ice: on each circle, the angles from the hull's inward normal to the places where the
/// ice's boundary first leaves the circle [rad].
using EdgeOpenings = std::array<geometry::WedgeAngles, kSectionCount>;

/// The push of a hull on an edge. Lengths are divided by the thickness h.
struct EdgePush {
  double length = 0;            ///< l / h
  double effective_length = 0;  ///< λ / h: l / h at rest; shorter if the inertia of ice and water supports the edge
  double distance = 0;          ///< x̄, distance of the load from the first touch
  double thrust = 0;            ///< η = H / V, inwards over down
  double lever = 0;             ///< height of the thrust above the middle plane
  double facet = 0;             ///< distance from the first touch to the far end of the crushed facet
};

/// The section at which an edge breaks.
struct SectionBreak {
  double force = 0;     ///< V_b / (σ_f h²); infinite if the thrust keeps every section closed
  double distance = 0;  ///< R / h, from the first touch
};

/// The bending moment in the sections of a narrow floating wedge, (ρ w'')'' + ρ w = 0, at the distance ρ from the tip
/// in units of λ: under a unit force on its tip (per λ), and under a unit moment there. Tabulated up to 4 λ, constant
/// beyond.
double moment_of_force(double distance);
double moment_of_moment(double distance);

/// Returns the ratio of the force that a whole edge carries to the force by bending of its sections alone [-], by the
/// opening of the section that breaks [rad]. From three-dimensional elements of wedges (docs/theory/bow.md).
double hold_of_whole(double opening);

/// Finds the section at which an edge breaks. If the edge is whole, the stress in the top fibre of a section of width w
/// is
///   σ h² / V = {6 [λ m_V(r/λ) − (x̄ + η e) m_M(r/λ)] − η} h / w
/// from bending under V, from the lever of the thrust, which lifts, and from the thrust itself, which compresses. A
/// cusp breaks off where this is largest: at the narrowest section that is far enough from the load. If a radial crack
/// has opened below, the stress is largest at the rims of the sections:
///   σ h² / V = {6 [A (λ m_V − x̄ m_M) − 0.31 η e m_M] − 0.93 η} h / w,
///   A = 0.87 + 0.18 (l/15h − 1) − 0.04 (θ − 2) + 0.19 |Δφ|,
/// where Δφ is the change of direction of the section's middle up to 1.56 r. This stress is flat along r, so R is the
/// mean place of the break for ice whose sections' strengths scatter by 0.2. Such an edge carries at most 0.585 (1 + ⟨θ
/// − π⟩), with θ the widest opening within 0.5 l: there the next radial cracks open. V is within 12 % and R within 24 %
/// of elements of 120 other edges (90th percentiles), in the range l/h 10 to 21 and η 1.3 to 3.9. At the stem, outside
/// of that range, V is 0.57 to 0.82 and R 0.84 to 1.46 times the elements'.
SectionBreak weakest_section(const EdgeOpenings& openings, const EdgePush& push);

}  // namespace polynya::fracture
