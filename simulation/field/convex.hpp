#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

// What is done to the convex counter-clockwise rings of a field's cells. Only + − × ÷ and √ are used.

struct CellMeasures {
  double area = 0;  ///< [m²]
  geometry::Point centroid;
};

/// From its first corner: cheaper than geometry::measure, and precise far from the origin.
CellMeasures measure_convex(const geometry::Ring& ring);

/// √ of the ratio of the principal second moments of area, ≥ 1: an ellipse's length over its width [-].
double aspect_of(const geometry::Ring& ring);

/// Leaves what lies to the left of the line; nothing of the ring may be left.
void clip_to_left(geometry::Ring& ring, geometry::Point from, geometry::Point to);

/// The ring with all its edges moved inwards [m]; nothing may be left.
geometry::Ring inset(const geometry::Ring& ring, double distance);

/// The ring by a factor larger about a point.
geometry::Ring scaled(const geometry::Ring& ring, geometry::Point centre, double factor);

/// Removes corners, those of least area first, until there are few enough and no edge is very short [m].
/// The result lies within the ring.
void reduce_corners(geometry::Ring& ring, int most, double shortest);

/// Cuts off corners, the sharpest first, until there are as many. The result lies within the ring.
void add_corners(geometry::Ring& ring, int least);

/// Cuts the ring across a direction into strips whose areas are in proportion to `shares`.
std::vector<geometry::Ring> strips_of(const geometry::Ring& ring, geometry::Vector direction,
                                      const std::vector<double>& shares);

/// Whether a ring comes nearer than the gap [m] to the boundary of another, which may be concave.
bool is_near_ring(const geometry::Ring& floe, const geometry::Ring& ring, double gap);

}  // namespace polynya::simulation
