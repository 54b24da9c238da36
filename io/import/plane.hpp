#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/import/floe_properties.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// Largest coordinate of a floe in the plane [m]. Farther floes are refused, because a larger coordinate usually means
/// another unit or coordinate system, or a wrong number.
inline constexpr double kFarthestFloe = 1e6;

/// Default of PlaneSettings::tolerance [m]. With it, an import followed by an export moves edges by at most a
/// millimetre.
inline constexpr double kEdgeTolerance = 0.0005;

/// A floe as a file describes it.
struct SourceFloe {
  geometry::Polygon polygon;  ///< rings as drawn, in the file's coordinates
  FloeProperties properties;
  std::string refused = {};            ///< reason why it is refused; empty: it is not
  std::optional<std::size_t> feature;  ///< number of the feature in the file to which the polygon belongs
  /// True if one of its edges lies on the meridian of longitude 180; set only if marks_180 asks for it.
  bool is_at_180 = false;
};

/// Statements of a file about its coordinate system.
struct FilePlace {
  std::string system;  ///< coordinate system that the file names, as GDAL knows it; may be empty
  StatedPlace stated;  ///< place that a file of Polynya states
};

/// Plane to which the floes of a file are projected.
struct PlaneSettings {
  std::optional<simulation::GeographicOrigin> origin;  ///< plane about this place on the Earth
  std::string target;                                  ///< plane of this projected system, "EPSG:3413"; may be empty
  std::string source;  ///< system of the file's coordinates, if the file names none; may be empty
  /// For a file in degrees without origin and target: use the middle of its floes as origin.
  bool chooses_origin = false;
  bool are_metres = false;  ///< coordinates are known to be metres, not degrees
  /// Coordinates of a file without a system that do not look like degrees stay as they are, even with an origin.
  bool keeps_metres = true;
  bool marks_180 = false;   ///< mark floes with an edge on the meridian of longitude 180
  bool is_shifted = false;  ///< move the middle of the box around all floes to (0, 0), in whole metres
  /// Largest distance between the exact image of an edge and the straight lines that replace it [m]. A smaller
  /// tolerance adds more points to edges. With 0 no points are added.
  double tolerance = kEdgeTolerance;
  /// Returns the option with which a user gives an origin [°], for messages.
  std::string (*origin_in_words)(double latitude, double longitude) = nullptr;
  std::string shift_in_words;   ///< option with which a user asks for a shift, for messages
  std::string source_in_words;  ///< option with which a user names the system of the file, for messages
};

/// How the coordinates were projected to the plane.
struct PlaneReport {
  std::string system;  ///< name of the file's system in PROJ; empty: the coordinates were metres of the plane
  std::optional<simulation::GeographicOrigin> origin;  ///< origin of the plane, if it is about one
  bool is_origin_chosen = false;                       ///< true if the program chose the origin
  std::string target;                                  ///< system of the plane, if it has one
  geometry::Vector shift;                              ///< vector that was added to the coordinates [m]
  std::size_t added_points = 0;  ///< number of points that were added to edges whose images are not straight
};

/// Reason why the floes of a file have no place in the plane.
struct PlaneError {
  std::optional<std::size_t> floe;  ///< index of the first floe with the fault; none: the fault is one of the file
  std::string words;
};

/// Projects floes and their velocities to metres in a plane, with GDAL. Floes that are refused already are not changed.
/// Further floes are refused if a coordinate is not finite, if a latitude is beyond ±90°, if a point has no image, or
/// if a point is farther than kFarthestFloe from the origin, as in the other hemisphere. If all floes have one of these
/// faults (for the last one: most floes), the whole file fails with it. The file also fails if it is in degrees without
/// a system or an origin, if PROJ does not know its system, or if the plane is not in metres. Coordinates without a
/// system that do not look like degrees (io/text/floe_text.hpp) are metres of the plane. A file that states its own
/// place (StatedPlace) keeps it unless another plane is asked for; then its floes are moved there.
tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const PlaneSettings& settings);

/// Returns true if two origins are the same place and heading, to within a hundredth of a millimetre.
bool are_one(const simulation::GeographicOrigin& a, const simulation::GeographicOrigin& b);

/// Describes the plane of a report, "the plane about 78.3° N, 15° E, x along 90°, shifted by (10, 20) m". Returns an
/// empty text if the plane has no place on the Earth.
std::string place_in_words(const PlaneReport& plane);

}  // namespace polynya::io
