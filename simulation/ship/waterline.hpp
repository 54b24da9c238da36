#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

/// The waterline of a hull, with arc lengths from its stem. The stem is the foremost point, or the middle of the
/// foremost edge.
struct Waterline {
  geometry::Ring ring;      ///< counter-clockwise, in the hull's frame [m]
  std::vector<double> arc;  ///< arc length of each vertex from the first one [m]
  double length = 0;        ///< length of the whole ring [m]
  double area = 0;          ///< area inside the ring [m²]
  double stem_arc = 0;      ///< arc length of the stem from the first vertex [m]
  double stem_x = 0;        ///< x of the stem in the hull's frame [m]
};

/// The point of a ring that is nearest to a given point.
struct NearestPlace {
  std::size_t edge = 0;
  double along = 0;       ///< place on the edge, from 0 at its start to 1 at its end
  geometry::Point point;  ///< the point, in the frame of the ring [m]
};
/// Returns the point of a ring that is nearest to `point`.
NearestPlace nearest_place(const geometry::Ring& ring, geometry::Point point);

/// A part of one edge of a ring, between two places on it from 0 to 1.
struct EdgePart {
  std::size_t edge = 0;
  double from = 0, to = 0;
};
/// Returns the parts of a ring's edges from one place to another, in the order of the ring.
std::vector<EdgePart> edges_between(const geometry::Ring& ring, const NearestPlace& from, const NearestPlace& to);

/// Returns the waterline of a ring in the hull's frame [m], which must run counter-clockwise.
Waterline waterline_of(const geometry::Ring& counter_clockwise);

/// Returns the arc length, from the stem, of the waterline's point that is nearest to a point in the hull's frame:
/// −length/2 to length/2, positive to port [m].
double arc_at(const Waterline& waterline, geometry::Point point);

}  // namespace polynya::simulation
