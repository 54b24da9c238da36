#pragma once

#include <array>
#include <cstddef>

#include "geometry/contact/crack_path.hpp"

namespace polynya::fracture {

/// Where the ice beside a contact is measured: on circles about the first touch, evenly spaced in ln r.
inline constexpr std::size_t kSectionCount = 12;
inline constexpr double kSectionStep = 1.25;  ///< from one r to the next

/// r / l of the sections.
inline constexpr std::array<double, kSectionCount> kSectionRadii = [] {
  std::array<double, kSectionCount> radii{0.08};
  for (std::size_t i = 1; i < kSectionCount; ++i) radii[i] = kSectionStep * radii[i - 1];
  return radii;
}();

/// The true outline of an edge of ice: on each circle the angles from the hull's inward normal to the places where the
/// ice's boundary first leaves it [rad].
using EdgeOpenings = std::array<geometry::WedgeAngles, kSectionCount>;

/// A hull's push on an edge. Lengths in the thickness h.
struct EdgePush {
  double length = 0;            ///< l / h
  double effective_length = 0;  ///< λ / h: l at rest; shorter where the inertia of ice and water holds the edge
  double distance = 0;          ///< x̄, of the load from the first touch
  double thrust = 0;            ///< η = H / V, inwards over down
  double lever = 0;             ///< of the thrust above the middle plane
  double facet = 0;             ///< from the first touch to the far end of what the hull has crushed
};

/// The section where an edge breaks.
struct SectionBreak {
  double force = 0;     ///< V_b / (σ_f h²); infinite where the thrust keeps every section closed
  double distance = 0;  ///< R / h, from the first touch
};

/// The moment in the sections of a narrow wedge that floats, (ρ w'')'' + ρ w = 0, by its distance ρ from the tip in λ:
/// of a unit force on its tip (per λ), and of a unit moment there. Tabulated up to 4 λ, held beyond.
double moment_of_force(double distance);
double moment_of_moment(double distance);

/// How much more an edge that stays whole bears than the bending of its sections alone, by the opening of the section
/// that breaks, by three-dimensional elements of wedges (docs/theory/bow.md).
double hold_of_whole(double opening);

/// The top fibre of a section of width w has, where the edge stays whole,
///   σ h² / V = {6 [λ m_V(r/λ) − (x̄ + η e) m_M(r/λ)] − η} h / w
/// by bending under V, by the thrust's lever, which lifts, and by the thrust itself, which closes. Where that
/// is most, a cusp breaks off: at the narrowest section that is far enough from the load. Where a radial crack has
/// opened below, the rims of the sections have most:
///   σ h² / V = {6 [A (λ m_V − x̄ m_M) − .31 η e m_M] − .93 η} h / w,
///   A = .87 + .18 (l/15h − 1) − .04 (θ − 2) + .19 |Δφ|,
/// Δφ how much the direction of the section's middle changes to 1.56 r, and R is where ice breaks on an average whose
/// sections' strengths scatter by .2: that stress is flat along r, so that its maximum is nowhere in particular. It
/// does not bear more than .585 (1 + ⟨θ − π⟩), θ the widest within .5 l: there the next radial cracks open.
/// V within 12 % and R within 24 % of elements of 120 other edges, 90th percentiles; range l/h 10 to 21, η 1.3 to 3.9;
/// at the stem, outside of that, V .57 to .82 and R .84 to 1.46 of the elements'.
SectionBreak weakest_section(const EdgeOpenings& openings, const EdgePush& push);

}  // namespace polynya::fracture
