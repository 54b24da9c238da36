#pragma once

#include <array>
#include <cmath>
#include <span>
#include <vector>

#include "dynamics/bodies.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::dynamics {

/// The readings of "projected area" A in Eq. (6).
enum class DragArea {
  kEdge,  ///< thickness × width across the motion: the drag acts on the floe's edge
  kPlan,  ///< the floe's area in plan
};

/// Makes the drag shape of a polygon about `centroid` in its frame. With kEdge it has the rotational drag integral
/// [m⁴]. With kPlan it has the area instead of widths [m²], and ∫ r³ dA, exact for the polygon [m⁵]. With `has_skin` it
/// also has ∫ r³ dA for the skin drag.
DragShape make_drag_shape(const geometry::Polygon& polygon, geometry::Point centroid, DragArea area = DragArea::kEdge,
                          bool has_skin = false);

/// Returns the k-th of the 128 directions over half a turn for which widths are computed; between them widths are
/// interpolated. The directions are spaced evenly around a diamond, because their index then follows without an
/// arctangent. They are not of unit length. Interpolated widths are accurate within 2e-4 for a square, and within
/// aspect/64 of the width of a slender piece whose kink lies between two directions.
geometry::Vector drag_direction(int k);

/// Returns the place of a direction (of any length > 0) among them, in [0, 128]: the inverse of drag_direction().
inline double drag_place(geometry::Vector d) {
  const bool is_behind = d.y < 0;
  const double x = is_behind ? -d.x : d.x;
  const double y = is_behind ? -d.y : d.y;
  const double from_axis = y / (std::abs(x) + y);
  return (x >= 0 ? from_axis : 2 - from_axis) * (0.5 * DragShape::kDirections);
}

/// Returns the widths of an outline with these corners across drag_direction(k) and the next one [m], 0 ≤ k < 128.
std::array<double, 2> widths_of_outline(std::span<const geometry::Point> corners, geometry::Point centroid, int k);

/// A current that grows linearly across its direction, in the water frame (which drifts with the uniform part of the
/// current).
struct ShearCurrent {
  geometry::Vector along{1, 0};  ///< unit direction of the current
  double rate = 0;               ///< growth per distance to port of `along` from the origin [1/s]
  geometry::Point origin;        ///< [m]

  bool is_still() const { return rate == 0; }
  geometry::Vector velocity_at(geometry::Point p) const { return rate * dot(perpendicular(along), p - origin) * along; }
  double angular_velocity() const { return -0.5 * rate; }  ///< of the water, half its vorticity [rad/s]
};

struct WaterDrag {
  double drag_coefficient = 0.5;  ///< C_D [-]
  double density = 1000;          ///< ρ_w [kg/m³]
  ShearCurrent current;
  DragArea area = DragArea::kEdge;  ///< reading of A, the same as in the bodies' drag shapes
  double skin_coefficient = 0;      ///< C_w of the skin drag on the floe's area in plan, in addition [-]
};

/// The effect of the water on the bodies over a step.
struct WaterWork {
  double lost = 0;           ///< energy lost by the motion relative to the surrounding water [J]
  double by_current = 0;     ///< energy gained from a current [J]
  geometry::Vector impulse;  ///< sum of the impulses on all bodies [N s]
  double impulses = 0;       ///< sum of the magnitudes of the impulses [N s]
};

/// Applies the drag of the water to every awake body over dt [s]. Eq. (6) of [Sawamura2017]:
///   F = −½ C_D ρ_w A |u| u,   A = h × width across u (DragArea::kEdge) or the area in plan (kPlan),
/// with u relative to the water at the centre of mass. The same law holds for the rotation, with ω relative to half the
/// vorticity of the water. Each strip at the distance s from the centre moves at ω s through the water, which gives M =
/// −½ C_D ρ_w h K |ω| ω with K = ∫|s|³ ds over the width, averaged over directions; in plan M = −½ C_D ρ_w ∫r³ dA |ω|
/// ω. The effect of a current's strain on rotation is left out; with it a long floe would not turn evenly. Deviation:
/// the paper prints the floe's own velocity for u, with which a drifting floe would be braked by its own current. Skin
/// drag on the area in plan S adds −½ C_w ρ_w S |u| u and −½ C_w ρ_w ∫r³ dA |ω| ω, which is exact for a floe that only
/// turns. The equations are solved exactly over the step for constant A, v⁺ = v / (1 + c |v| dt), which is stable for
/// any step. The kinetic energy of the bodies changes by by_current − lost.
WaterWork apply_water_drag(Bodies& bodies, const std::vector<BodyIndex>& awake, const WaterDrag& water, double dt,
                           int threads = 1);

}  // namespace polynya::dynamics
