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

/// Largest magnitude of a coordinate of a floe in the plane, and largest distance from the origin to which floes are
/// projected [m]. Farther floes are refused, because a larger coordinate usually means another unit or coordinate
/// system, or a wrong number. At this distance a plane about an origin is wrong by 0.4 % in length (frame_about). A
/// larger value accepts larger errors and more wrong numbers; a smaller one refuses more files of large regions.
inline constexpr double kFarthestFloe = 1e6;

/// Default of PlaneSettings::tolerance, and of the tolerance of exports [m]. With it, an import followed by an export
/// moves edges by at most a millimetre. A larger value saves points of long edges, but moves edges more.
inline constexpr double kEdgeTolerance = 0.0005;

/// A floe of a file. bring_to_plane() replaces the file's coordinates by those of the plane.
struct SourceFloe {
  /// Rings as drawn in the file: in either direction, closed or open. In the units of the file before, and in metres in
  /// the plane after bring_to_plane().
  geometry::Polygon polygon;
  FloeProperties properties;                ///< what the file says about the floe; its velocity turns with the axes
  std::string refused = {};                 ///< reason why it is refused; empty: it is not
  std::optional<std::size_t> feature = {};  ///< number of the feature in the file to which the polygon belongs
  /// True if one of its edges lies on the meridian of longitude 180, where files divide floes; such parts may be
  /// joined again. Set only with PlaneSettings::marks_180.
  bool is_at_180 = false;
};

/// The statement of a file about its coordinate system.
struct FilePlace {
  std::string system;  ///< coordinate system that the file names, as GDAL knows it; empty: it names none
  StatedPlace stated;  ///< place on the Earth that the file states, if Polynya wrote it
};

/// Plane to which the floes of a file are projected. At most one of `origin` and `target` is given. Without both,
/// coordinates in metres keep their plane.
struct PlaneSettings {
  std::optional<simulation::GeographicOrigin> origin;  ///< use the plane about this place (frame_about)
  std::string target;  ///< use the plane of this projected system in metres, "EPSG:3413"; empty: none
  std::string source;  ///< system of the coordinates of a file that names none; a file that names another is refused
  /// For a file in degrees without origin and target. True: the middle of its floes becomes the origin, with the x axis
  /// to the east. False: the file is refused.
  bool chooses_origin = false;
  /// True: coordinates of a file without a system are metres, even if they look like degrees. It has no effect on a
  /// file that names or states its system, or if `source` names one.
  bool are_metres = false;
  /// For a file without a system, if an origin is given and the coordinates do not look like degrees. True: they are
  /// metres of the plane about the origin, and are kept. False: the file is refused.
  bool keeps_metres = true;
  bool marks_180 = false;   ///< set SourceFloe::is_at_180; it takes time if the file is not in degrees
  bool is_shifted = false;  ///< move the middle of the box around all floes to (0, 0), by whole metres
  /// Largest distance between the exact image of an edge and the straight lines that replace it [m]; at least 0. A
  /// smaller tolerance adds more points to edges. With 0 no points are added.
  double tolerance = kEdgeTolerance;
  /// Returns the option or key with which a user gives an origin [°], for messages. It must be set.
  std::string (*origin_in_words)(double latitude, double longitude) = nullptr;
  std::string shift_in_words;   ///< option with which a user asks for a shift, for messages
  std::string source_in_words;  ///< option with which a user names the system of the file, for messages
};

/// How the coordinates were projected to the plane.
struct PlaneReport {
  /// Name in PROJ of the system of the file's coordinates. If an origin was asked for and the file states a place of
  /// its own, it is that place in words. Empty: the file names no system, so that its coordinates were taken as metres
  /// of the plane, or it states a place and no origin was asked for.
  std::string system;
  std::optional<simulation::GeographicOrigin> origin;  ///< origin of the plane, if it is about one
  bool is_origin_chosen = false;                       ///< true if the program chose the origin
  std::string target;                                  ///< projected system of the plane; empty if it is of none
  geometry::Vector shift;        ///< vector that was added to coordinates of that plane, also before the import [m]
  std::size_t added_points = 0;  ///< number of points that were added to edges whose images are not straight
};

/// Reason why the floes of a file cannot be brought to the plane.
struct PlaneError {
  std::optional<std::size_t> floe;  ///< index of the first floe with the fault; none: the fault is one of the file
  std::string words;                ///< message
};

/// Projects floes and their velocities to metres in a plane, with GDAL, and returns a report on it. After an error the
/// floes are partly changed and must not be used. Floes that are refused already are not projected. Further floes are
/// refused, with the reason in SourceFloe::refused:
/// - if a coordinate is not finite,
/// - if a latitude is beyond ±90° or a longitude beyond ±540°,
/// - if a point has no image in the plane,
/// - if a point is farther than kFarthestFloe from the origin to which it is projected, for example in the other
///   hemisphere,
/// - if a coordinate in the plane, after the shift, is beyond ±kFarthestFloe.
/// If all floes have one of these faults, or more than half of them the last one, the whole file fails with it. The
/// file also fails if it is in degrees and neither an origin nor a target is given (unless one may be chosen), if PROJ
/// does not know its system, if the plane is not in metres, if the file names another system than `source`, or if GDAL
/// is needed and missing. The rules for the system come in this order: a place that the file states (StatedPlace), the
/// system that it names, PlaneSettings::source, and then the coordinates themselves. Coordinates without a system that
/// do not look like degrees (CoordinateEvidence) are metres of the plane; with an origin they are also degrees if at
/// least a tenth of the floes lie near it as degrees, or if all ice would be less than 1 m². A file that states its own
/// place keeps it unless another plane is asked for; then its floes are moved there.
tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const PlaneSettings& settings);

/// Returns true if two origins have the same latitude, longitude and heading, to 1e-12 rad, which is less than 0.01 mm
/// on the Earth.
bool are_one(const simulation::GeographicOrigin& a, const simulation::GeographicOrigin& b);

/// Describes the plane of a report for messages, "the plane about 78.3° N, 15° E, x along 90°, shifted by (10, 20) m".
/// Returns an empty text if the plane has no place on the Earth, even if it is shifted.
std::string place_in_words(const PlaneReport& plane);

}  // namespace polynya::io
