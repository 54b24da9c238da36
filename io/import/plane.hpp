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

inline constexpr double kFarthestFloe = 1e6;  ///< a coordinate in the plane [m]

/// Largest distance between an edge and its image where points are added to it, if no other is given [m]. An import and
/// an export together stay within a millimetre.
inline constexpr double kEdgeTolerance = 0.0005;

/// A floe as a file has it.
struct SourceFloe {
  geometry::Polygon polygon;  ///< rings as drawn, in the file's coordinates
  FloeProperties properties;
  std::string refused = {};            ///< why it is; empty: it is not
  std::optional<std::size_t> feature;  ///< the feature of the file that it is a polygon of, by number
  bool is_at_180 = false;  ///< an edge of it lies on the meridian of longitude 180, where that was asked for
};

/// What a file states of where its coordinates lie.
struct FilePlace {
  std::string system;  ///< the coordinate system that it names, as GDAL knows it; or empty
  StatedPlace stated;  ///< of a file that Polynya wrote
};

/// Which plane the floes of a file come to.
struct PlaneSettings {
  std::optional<simulation::GeographicOrigin> origin;  ///< that about a place on the Earth
  std::string target;                                  ///< that of a projected system, "EPSG:3413"; or empty
  std::string source;                                  ///< the file's system, where the file names none; or empty
  bool chooses_origin = false;                         ///< of a file in degrees without either: the middle of its floes
  bool are_metres = false;                             ///< known to be no degrees
  bool keeps_metres = true;  ///< also beside an origin, of a file without system that is not in degrees
  bool marks_180 = false;    ///< floes with an edge on the meridian of longitude 180 are marked
  bool is_shifted = false;   ///< then the middle of the floes' box comes to (0, 0), to a metre
  /// Largest distance between the image of an edge and the straight lines that are put in its place [m]. A smaller
  /// tolerance adds more points to edges. With 0 no points are added.
  double tolerance = kEdgeTolerance;
  /// How a user gives an origin [°], in messages.
  std::string (*origin_in_words)(double latitude, double longitude) = nullptr;
  std::string shift_in_words;   ///< likewise
  std::string source_in_words;  ///< likewise
};

/// How the coordinates came to the plane.
struct PlaneReport {
  std::string system;  ///< the file's: its name as PROJ has it; empty: metres of the plane
  std::optional<simulation::GeographicOrigin> origin;  ///< of the plane, where it is about one
  bool is_origin_chosen = false;                       ///< by the program
  std::string target;                                  ///< the plane's system, where it is that of one
  geometry::Vector shift;                              ///< that was added [m]
  std::size_t added_points = 0;                        ///< to edges that are not straight in the plane
};

/// Why the floes of a file have no place in the plane.
struct PlaneError {
  std::optional<std::size_t> floe;  ///< the first of which it is true; none: of the file
  std::string words;
};

/// Brings floes to metres in a plane, by GDAL, their velocities with them. Floes that are refused are left as they are.
/// Refused are then also those with a coordinate that is not finite, with a latitude beyond ±90, without an image, and
/// farther than kFarthestFloe from the origin (in the other hemisphere, say). Where that is all of them (most, of those
/// far in the plane), it is the error; others are degrees without a system or an origin, systems that PROJ does not
/// know, and planes that are not in metres. Coordinates without system that do not look like degrees
/// (io/text/floe_text.hpp) are metres of the plane. A file that states its own place (StatedPlace) keeps it where no
/// other plane is asked for; else its floes are moved to that plane.
tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const PlaneSettings& settings);

/// Whether two origins are one: within a hundredth of a millimetre.
bool are_one(const simulation::GeographicOrigin& a, const simulation::GeographicOrigin& b);

/// The plane of a report in words, "the plane about 78.3° N, 15° E, x along 90°, shifted by (10, 20) m"; empty where it
/// lies nowhere on the Earth.
std::string place_in_words(const PlaneReport& plane);

}  // namespace polynya::io
