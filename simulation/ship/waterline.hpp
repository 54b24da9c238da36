#pragma once

#include <vector>

#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

/// Places on a hull's waterline, by their arc length from its stem: its foremost point, or the middle of its foremost
/// edge.
struct Waterline {
  geometry::Ring ring;      ///< counter-clockwise, in the hull's frame [m]
  std::vector<double> arc;  ///< of each vertex from the first one [m]
  double length = 0;        ///< of all of it [m]
  double area = 0;          ///< within it [m²]
  double stem_arc = 0;      ///< of the stem from the first vertex [m]
  double stem_x = 0;        ///< [m]
};

/// Where a ring comes nearest to a point.
struct NearestPlace {
  std::size_t edge = 0;
  double along = 0;       ///< the edge, 0 to 1
  geometry::Point point;  ///< [m]
};
NearestPlace nearest_place(const geometry::Ring& ring, geometry::Point point);

/// A part of one edge of a ring, from one share of it to another.
struct EdgePart {
  std::size_t edge = 0;
  double from = 0, to = 0;
};
/// The edges of a ring from one of its places to another, in its order.
std::vector<EdgePart> edges_between(const geometry::Ring& ring, const NearestPlace& from, const NearestPlace& to);

Waterline waterline_of(const geometry::Ring& counter_clockwise);

/// Of the waterline's point nearest to one of the hull's frame, from the stem, to port, to starboard negative:
/// −length/2 to length/2 [m].
double arc_at(const Waterline& waterline, geometry::Point point);

}  // namespace polynya::simulation
