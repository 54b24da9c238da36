#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

// Operations on the convex counter-clockwise rings of a field's cells. They use only + − × ÷ and √, which give the same
// bits on every machine.

/// Area and centroid of a ring.
struct CellMeasures {
  double area = 0;  ///< [m²]
  geometry::Point centroid;
};

/// Returns the measures of a convex ring. Coordinates are taken relative to its first corner, so they are precise far
/// from the origin, and the function is cheaper than geometry::measure.
CellMeasures measure_convex(const geometry::Ring& ring);

/// Returns the aspect of a ring: the square root of the ratio of the principal second moments of area, ≥ 1 [-]. For an
/// ellipse it is length over width.
double aspect_of(const geometry::Ring& ring);

/// Cuts off the part of a ring to the right of the line through two points. The ring is empty if nothing is left.
void clip_to_left(geometry::Ring& ring, geometry::Point from, geometry::Point to);

/// Returns a ring with all its edges moved inwards by a distance [m]; empty if nothing is left.
geometry::Ring inset(const geometry::Ring& ring, double distance);

/// Returns a ring enlarged by a factor about a point.
geometry::Ring scaled(const geometry::Ring& ring, geometry::Point centre, double factor);

/// Removes corners, beginning with the one that cuts off the least area, until there are at most `most` of them and no
/// edge is shorter than `shortest` [m]. The result lies inside the ring.
void reduce_corners(geometry::Ring& ring, int most, double shortest);

/// Cuts off corners, beginning with the sharpest, until there are at least `least` corners. The result lies inside the
/// ring.
void add_corners(geometry::Ring& ring, int least);

/// Cuts a ring across a direction into strips whose areas are in proportion to `shares`.
std::vector<geometry::Ring> strips_of(const geometry::Ring& ring, geometry::Vector direction,
                                      const std::vector<double>& shares);

/// Returns true if a convex ring comes nearer than `gap` [m] to the boundary of another ring, which may be concave.
bool is_near_ring(const geometry::Ring& floe, const geometry::Ring& ring, double gap);

}  // namespace polynya::simulation
