#pragma once

#include "geometry/shape/point.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::io {

// Functions for rings and lines in longitude and latitude [°], longitude first. Coordinates in degrees are not a plane:
// adding 360° to a longitude gives the same place, a pole has every longitude, and a ring around a pole can be drawn
// only with a seam that leads to the pole. These functions change the notation of points, or add and remove the points
// of such seams. They never change the outline on the Earth.

/// Returns true if the latitude of a point is that of a pole, to 1e-10° (0.01 mm). Its longitude means nothing then.
/// The margin admits latitudes that were rounded. With a larger one, points near a pole would lose their longitudes.
bool is_pole(geometry::Point point);

/// Returns the longitude [°] that names the same meridian and differs from `near` [°] by at most 180°. A longitude that
/// does so already is returned unchanged, to the bit.
double longitude_near(double longitude, double near);

/// Returns the same place with a longitude from -180 to 180, and with longitude 0 at a pole. So each place has one
/// notation, except on the meridian of longitude 180, where 180 and -180 both occur.
geometry::Point in_one_notation(geometry::Point point);

/// Returns a line or ring in which consecutive longitudes differ by at most 180°, because each edge takes the shorter
/// way around the Earth. The first point that is not a pole keeps its longitude. A line enters and leaves a pole on the
/// meridians of its neighbours there, so a pole may become two points. `is_closed`: an edge also leads from the last
/// point to the first. In a ring around a pole the longitudes of that edge differ by about a full turn. Points that are
/// all poles are returned unchanged.
geometry::Ring continuous(const geometry::Ring& points, bool is_closed);

/// Returns a ring without edges that lead to a pole and back on one meridian. They are the seam with which a ring
/// around a pole is drawn in degrees. A pole that is a true corner of the ring stays. Points within 1e-9° (0.1 mm) of
/// their predecessor are removed too. A ring without a pole is unchanged. A ring that is nothing but a seam is left
/// with two points, which are no outline.
geometry::Ring without_seams(geometry::Ring ring);

/// Returns a polygon in longitude and latitude [°] as files and maps draw it: longitudes are continuous, and that of
/// the first point differs from `longitude` [°] by at most 180°. A caller passes one longitude for all polygons of a
/// file, so that they lie side by side. Holes are drawn at the longitudes of the outer ring. The rings that are passed
/// must have the material on their left, which decides on which side of a pole it lies. A ring around a pole gets a
/// seam, which leads from the ring to the pole on one meridian and back on the same meridian 360° away. The seam begins
/// at the point of the ring nearest to the pole. If it would cross a ring there, it begins at the first vertex where it
/// crosses none.
geometry::Polygon drawn_in_degrees(const geometry::Polygon& polygon, double longitude);

/// Returns a line as it is drawn in degrees: longitudes are continuous, and the first one differs from `longitude` [°]
/// by at most 180°. A line gets no seam.
geometry::Ring line_in_degrees(const geometry::Ring& line, double longitude);

}  // namespace polynya::io
