#pragma once

#include <array>
#include <span>

#include "dynamics/bodies.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::dynamics {

/// What the "projected area" A of Eq. (6) is read as.
enum class DragArea {
  kEdge,  ///< thickness × width across the motion: the floe's edge meets the water
  kPlan,  ///< the floe's area in plan
};

/// By edge: width of a shape across each direction [m] and its rotational drag integral [m⁴], about
/// `centroid` in its frame. By plan: the area in place of the widths [m²], and ∫ r³ dA, exact for the polygon
/// [m⁵]. `has_skin`: with ∫ r³ dA for the skin drag too.
DragShape make_drag_shape(const geometry::Polygon& polygon, geometry::Point centroid, DragArea area = DragArea::kEdge,
                          bool has_skin = false);

/// The same, its widths not kept where widths_of_outline() finds them as fast: those of one floe are 1 KB.
DragShape make_small_drag_shape(const geometry::Polygon& polygon, geometry::Point centroid,
                                DragArea area = DragArea::kEdge, bool has_skin = false);

/// The widths of an outline of these corners across drag_direction(k) and the next [m], 0 ≤ k < 128: to the
/// bit those of make_drag_shape().
std::array<double, 2> widths_of_outline(std::span<const geometry::Point> corners, geometry::Point centroid, int k);

/// The k-th of the 128 directions over half a turn at which widths are known: evenly around a diamond, since
/// that needs no arctangent to find a direction's place among them. Not of unit length.
geometry::Vector drag_direction(int k);

}  // namespace polynya::dynamics
