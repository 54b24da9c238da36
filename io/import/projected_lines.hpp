#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// Coordinates in which points are given: those of a coordinate system, turned about its origin by −`turn` and then
/// shifted by `shift`. Frames in degrees are neither turned nor shifted. If both flags are false, the coordinates lie
/// in a plane whose unit is not metres, such as feet.
struct CoordinateFrame {
  std::string system;           ///< coordinate system: a code, PROJ string or WKT that find_crs() accepts
  bool is_in_degrees = false;   ///< true: coordinates are longitude and latitude [°], longitude first
  bool is_metric = false;       ///< true: coordinates lie in a plane and are in metres
  double turn = 0;              ///< direction of the frame's x axis in the system, counter-clockwise [rad]
  geometry::Vector shift = {};  ///< vector that was added to the coordinates after they were turned [m]
};

/// Returns the plane about a place on WGS 84, in metres, with the origin at (0, 0) and the x axis along the origin's
/// heading. The projection is azimuthal equidistant (PROJ's aeqd). Distances and directions from the origin are exact.
/// At the distance d from the origin, lengths across that direction have a relative error of d²/(6 R²), with R the
/// radius of the Earth: 4 mm over 10 km.
CoordinateFrame frame_about(const simulation::GeographicOrigin& origin);

/// Returns the frame of longitude and latitude on WGS 84.
CoordinateFrame in_degrees();

/// Transforms points from one frame to another, and returns them in their order. A point without an image in the other
/// system becomes NaN. GDAL is not needed if both frames have the same system; otherwise fails if it is missing or
/// refuses a system.
Result<std::vector<geometry::Point>> project(const std::vector<geometry::Point>& points, const CoordinateFrame& from,
                                             const CoordinateFrame& to);

/// A line or a ring in two frames: the file's coordinates and the plane, or the other way round.
struct ProjectedLine {
  geometry::Ring from;     ///< points in the frame that is transformed
  geometry::Ring to;       ///< image of each point of `from` in the other frame; NaN if it has none
  bool is_closed = false;  ///< true: a ring, with an edge from the last point to the first
};

// Lines are transformed in four calls: line_in() makes each, then project_vertices(), add_points(), and image_of() of
// each.

/// Returns a line in the form that project_vertices() expects, without images yet. `points` are in `frame`; a ring may
/// repeat its first point at its end, and the result does not. In degrees its longitudes are made continuous (no jump
/// of 360° at longitude 180), and the seam of a ring around a pole, along which files lead to the pole and back, is
/// removed.
ProjectedLine line_in(const CoordinateFrame& frame, geometry::Ring points, bool is_closed);

/// Computes the image `to` of each point of the lines. Fails as project() does; then the images remain as they were.
Result<> project_vertices(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to);

/// Adds points to edges, because the image of a straight edge is curved. Edges are halved, at most 20 times, until
/// their straight images are within `tolerance` [m] of the curved ones. A smaller tolerance adds more points; with 0,
/// NaN or a negative one, or if both frames have the same system, none are added. The added points do not depend on the
/// direction in which an edge is drawn, so two floes with a common edge keep it. Needs the images of
/// project_vertices(); lines with an image that is NaN get no points. Fails as project() does; then the lines remain as
/// they were.
Result<> add_points(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to,
                    double tolerance);

/// Returns the image of a line, in the frame `to`. In a ring, equal neighbouring points are removed, so it may have
/// less than three points; they occur because a pole, which has every longitude, may be several points in degrees.
geometry::Ring image_of(const ProjectedLine& line);

}  // namespace polynya::io
