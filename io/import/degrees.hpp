#pragma once

#include "geometry/shape/point.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::io {

// Functions for rings and lines in longitude and latitude [°], longitude first. Coordinates in degrees are not a plane:
// adding 360° to a longitude gives the same place, a pole has every longitude, and a ring around a pole can be drawn
// only with a seam that leads to the pole. These functions change the notation, never the place on the Earth.

/// Returns true if a point is one of the poles, to 1e-10° (0.01 mm).
bool is_pole(geometry::Point point);

/// Returns the longitude [°] that names the same meridian and differs from `near` by at most 180°.
double longitude_near(double longitude, double near);

/// Returns the same place with a longitude from -180 to 180, and with longitude 0 at a pole, so that each place has one
/// notation.
geometry::Point in_one_notation(geometry::Point point);

/// Makes longitudes continuous, because each edge takes the shorter way around the Earth. A ring enters and leaves a
/// pole on the meridians of its neighbours there, so a pole may become two points. `is_closed`: an edge leads from the
/// last point to the first.
geometry::Ring continuous(const geometry::Ring& points, bool is_closed);

/// Removes edges that lead only to a pole and back. They are the seam with which a ring around a pole is drawn in
/// degrees.
geometry::Ring without_seams(geometry::Ring ring);

/// Returns a polygon as it is drawn in degrees: longitudes are continuous, and the first one differs from `longitude`
/// [°] by at most 180°. Rings have the material on their left. A ring around a pole gets a seam, which follows a
/// meridian from the ring to the pole and returns on the meridian 360° further. The seam begins at the point of the
/// ring nearest to the pole. If it would cross the boundary there, it begins at a vertex where it does not.
geometry::Polygon drawn_in_degrees(const geometry::Polygon& polygon, double longitude);

/// Returns a line as it is drawn in degrees, in the same way.
geometry::Ring line_in_degrees(const geometry::Ring& line, double longitude);

}  // namespace polynya::io
