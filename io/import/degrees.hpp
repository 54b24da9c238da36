#pragma once

#include "geometry/shape/point.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::io {

// Rings and lines in longitude and latitude [°], longitude first. Coordinates in degrees are not a plane: a longitude
// and one turn more name the same place, a pole has every longitude, and a ring around a pole can only be drawn with a
// seam that leads to it. These functions change the notation, never the place on the Earth.

/// Whether a point is one of the poles, to 1e-10° (0.01 mm).
bool is_pole(geometry::Point point);

/// The longitude that names the same meridian and differs from `near` by at most half a turn.
double longitude_near(double longitude, double near);

/// The same place with a longitude from -180 to 180, and 0 at a pole: one notation for each place.
geometry::Point in_one_notation(geometry::Point point);

/// Makes longitudes continuous: each edge takes the shorter way around the Earth. A pole is entered and left on the
/// meridian of its neighbour, so it may become two points. `is_closed`: the last point has an edge to the first.
geometry::Ring continuous(const geometry::Ring& points, bool is_closed);

/// Removes what only leads to a pole and back: a seam, by which a ring in degrees is drawn around a pole.
geometry::Ring without_seams(geometry::Ring ring);

/// A polygon as it is drawn in degrees: longitudes are continuous, and the first of them differs from `longitude` by at
/// most half a turn. Rings have the material on their left. A ring that goes around a pole gets a seam, which follows a
/// meridian from the ring to the pole and comes back one turn further; it begins at the point of the ring nearest to
/// the pole, or where that seam would cross the boundary, at a vertex whose seam does not.
geometry::Polygon drawn_in_degrees(const geometry::Polygon& polygon, double longitude);

/// A line as it is drawn in degrees, likewise.
geometry::Ring line_in_degrees(const geometry::Ring& line, double longitude);

}  // namespace polynya::io
