#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// Where coordinates lie: in a coordinate system, moved and turned.
struct CoordinateFrame {
  std::string system;           ///< as GDAL knows it (find_crs)
  bool is_in_degrees = false;   ///< longitude and latitude
  bool is_metric = false;       ///< a plane in metres
  double turn = 0;              ///< direction of the x axis in the system, counter-clockwise [rad]
  geometry::Vector shift = {};  ///< that was added to the coordinates after they were turned
};

/// The plane about a place on WGS 84: azimuthal equidistant (PROJ's aeqd), the x axis along the origin's heading.
/// Distances and directions from the origin are exact; across them lengths are right to d²/(6 R²) of themselves, d from
/// the origin: 4 mm over 10 km.
CoordinateFrame frame_about(const simulation::GeographicOrigin& origin);

/// Longitude and latitude on WGS 84.
CoordinateFrame in_degrees();

/// Points of one frame in another, in their order. A point without an image becomes NaN.
Result<std::vector<geometry::Point>> project(const std::vector<geometry::Point>& points, const CoordinateFrame& from,
                                             const CoordinateFrame& to);

/// A line, or a ring, in two frames.
struct ProjectedLine {
  geometry::Ring from;
  geometry::Ring to;  ///< the image of each point of `from`; NaN where it has none
  bool is_closed = false;
};

/// A line as project_vertices expects it: in degrees with continuous longitudes, and without seams to a pole.
ProjectedLine line_in(const CoordinateFrame& frame, geometry::Ring points, bool is_closed);

/// Fills in the images of all points.
Result<> project_vertices(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to);

/// Adds points to edges whose straight images would leave the images of the edges by more than `tolerance` [m], by
/// halving them. Which points are added to an edge does not depend on the direction in which it is drawn, so that
/// neighbours that share an edge share its image. The images are there (project_vertices); lines with NaN are left out.
Result<> add_points(std::vector<ProjectedLine>& lines, const CoordinateFrame& from, const CoordinateFrame& to,
                    double tolerance);

/// The image; of a ring without the points that stand twice because a pole has every longitude.
geometry::Ring image_of(const ProjectedLine& line);

}  // namespace polynya::io
