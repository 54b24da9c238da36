#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// Coordinates of a coordinate system, turned and shifted.
struct CoordinateFrame {
  std::string system;           ///< coordinate system, as GDAL knows it (find_crs)
  bool is_in_degrees = false;   ///< coordinates are longitude and latitude [°]
  bool is_metric = false;       ///< coordinates lie in a plane and are in metres
  double turn = 0;              ///< direction of the x axis in the system, counter-clockwise [rad]
  geometry::Vector shift = {};  ///< vector that was added to the coordinates after they were turned [m]
};

/// Returns the plane about a place on WGS 84: azimuthal equidistant (PROJ's aeqd), with the x axis along the heading of
/// the origin. Distances and directions from the origin are exact. At the distance d from the origin, lengths across
/// that direction have a relative error of d²/(6 R²), with R the radius of the Earth: 4 mm over 10 km.
CoordinateFrame frame_about(const simulation::GeographicOrigin& origin);

/// Returns the frame of longitude and latitude on WGS 84.
CoordinateFrame in_degrees();

/// Transforms points from one frame to another, in their order. A point without an image becomes NaN.
Result<std::vector<geometry::Point>> project(const std::vector<geometry::Point>& points, const CoordinateFrame& from,
                                             const CoordinateFrame& to);

/// A line or a ring in two frames.
struct ProjectedLine {
  geometry::Ring from;
  geometry::Ring to;  ///< image of each point of `from`; NaN if it has none
  bool is_closed = false;
};

/// Returns a line as project_vertices expects it: in degrees its longitudes are continuous and it has no seams to a
/// pole.
ProjectedLine line_in(const CoordinateFrame& frame, geometry::Ring points, bool is_closed);

/// Computes the images of all points.
Result<> project_vertices(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to);

/// Halves edges, by adding points, until their straight images are within `tolerance` [m] of the exact ones. The added
/// points do not depend on the direction in which an edge is drawn, so that two floes with a common edge keep it. Needs
/// the images of project_vertices; lines with NaN are left out.
Result<> add_points(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to,
                    double tolerance);

/// Returns the image of a line. Points of a ring that occur twice because a pole has every longitude are removed.
geometry::Ring image_of(const ProjectedLine& line);

}  // namespace polynya::io
