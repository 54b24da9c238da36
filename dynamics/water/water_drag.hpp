#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "dynamics/bodies.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::dynamics {

/// What the "projected area" A of Eq. (6) is read as.
enum class DragArea {
  kEdge,  ///< thickness × width across the motion: the floe's edge meets the water
  kPlan,  ///< the floe's area in plan
};

/// By edge: the rotational drag integral of a shape about `centroid` in its frame [m⁴]. By plan: the area in place of
/// its widths [m²], and ∫ r³ dA, exact for the polygon [m⁵]. `has_skin`: with ∫ r³ dA for the skin drag too.
DragShape make_drag_shape(const geometry::Polygon& polygon, geometry::Point centroid, DragArea area = DragArea::kEdge,
                          bool has_skin = false);

/// The k-th of the 128 directions over half a turn at which widths are found, and interpolated between them: evenly
/// around a diamond, since that needs no arctangent to find a direction's place among them. Not of unit length.
/// Widths are so within 2e-4 for a square, and within aspect/64 of the width of a slender piece where its kink falls
/// between two.
geometry::Vector drag_direction(int k);

/// Where a direction (of any length > 0) is among them, from [0, 128]: the inverse of drag_direction().
inline double drag_place(geometry::Vector d) {
  const bool is_behind = d.y < 0;
  const double x = is_behind ? -d.x : d.x;
  const double y = is_behind ? -d.y : d.y;
  const double from_axis = y / (std::abs(x) + y);
  return (x >= 0 ? from_axis : 2 - from_axis) * (0.5 * DragShape::kDirections);
}

/// The widths of an outline of these corners across drag_direction(k) and the next [m], 0 ≤ k < 128.
std::array<double, 2> widths_of_outline(std::span<const geometry::Point> corners, geometry::Point centroid, int k);

/// A current that grows linearly across its direction, in the water frame (which drifts with the uniform
/// part).
struct ShearCurrent {
  geometry::Vector along{1, 0};  ///< unit direction of the current
  double rate = 0;               ///< per distance to port of `along` from the origin [1/s]
  geometry::Point origin;        ///< [m]

  bool is_still() const { return rate == 0; }
  geometry::Vector velocity_at(geometry::Point p) const { return rate * dot(perpendicular(along), p - origin) * along; }
  double angular_velocity() const { return -0.5 * rate; }  ///< of the water, half its vorticity [rad/s]
};

struct WaterDrag {
  double drag_coefficient = 0.5;  ///< C_D [-]
  double density = 1000;          ///< ρ_w [kg/m³]
  ShearCurrent current;
  DragArea area = DragArea::kEdge;  ///< A, as the bodies' drag shapes have it
  double skin_coefficient = 0;      ///< C_w, of the floe's area in plan, on top [-]
};

/// What the water did to the bodies over a step.
struct WaterWork {
  double lost = 0;           ///< energy of the motion relative to the water around [J]
  double by_current = 0;     ///< energy from a current [J]
  geometry::Vector impulse;  ///< on them all together [N s]
  double impulses = 0;       ///< sum of the impulses' sizes [N s]
};

/// Applies the drag of the water to every awake body over dt [s]. Eq. (6) of [Sawamura2017]:
///   F = −½ C_D ρ_w A |u| u,   A = h × width across u (DragArea::kEdge) or the area in plan (kPlan),
/// with u relative to the water at the centre of mass, and the same law for the rotation, ω relative to half
/// the water's vorticity, each strip at distance s from the centre moving at ω s through the water:
/// M = −½ C_D ρ_w h K |ω| ω, K = ∫|s|³ ds over the width, averaged over directions; in plan
/// M = −½ C_D ρ_w ∫r³ dA |ω| ω. The effect of a current's strain on rotation is left out: a long floe would
/// not turn evenly. Deviation: the paper prints the floe's own velocity for u; a drifting floe would be
/// braked by its own current. Skin drag on the area in plan S adds −½ C_w ρ_w S |u| u and
/// −½ C_w ρ_w ∫r³ dA |ω| ω, which is exact for a floe that only turns. Solved exactly over the step for
/// constant A, v⁺ = v / (1 + c |v| dt): stable for any step. The bodies' kinetic energy changes by by_current
/// − lost.
WaterWork apply_water_drag(Bodies& bodies, const std::vector<BodyIndex>& awake, const WaterDrag& water, double dt,
                           int threads = 1);

}  // namespace polynya::dynamics
