#pragma once

#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/import/floe_properties.hpp"
#include "io/import/projection.hpp"

namespace polynya::io {

inline constexpr double kFarthestFloe = 1e6;  ///< a coordinate in the plane [m]

/// A floe as a file has it.
struct SourceFloe {
  geometry::Polygon polygon;  ///< rings as drawn, in the file's coordinates
  FloeProperties properties;
  std::string refused;  ///< why it is; empty: it is not
};

/// Which plane the floes of a file come to.
struct PlaneSettings {
  std::optional<simulation::GeographicOrigin> origin;  ///< that about a place on the Earth
  std::string target;                                  ///< that of a projected system, "EPSG:3413"; or empty
  std::string source;                                  ///< the file's system, where the file names none; or empty
  bool chooses_origin = false;                         ///< of a file in degrees without either: the middle of its floes
  bool are_metres = false;                             ///< known to be no degrees
  bool keeps_metres = true;  ///< also beside an origin, of a file without system that is not in degrees
  bool is_shifted = false;   ///< then the middle of the floes' box comes to (0, 0), to a metre
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
};

/// Why the floes of a file have no place in the plane.
struct PlaneError {
  std::optional<std::size_t> floe;  ///< the first of which it is true; none: of the file
  std::string words;
};

/// Brings floes to metres in a plane, by PROJ, their velocities with them. `crs` is the system that the file
/// names, or empty. Floes that are refused are left as they are. Refused are then also those with a coordinate that
/// is not finite, with a latitude beyond ±90, without an image, and farther than kFarthestFloe from the origin (in the
/// other hemisphere, say). Where that is all of them (most, of those far in the plane), it is the error; others are
/// degrees without a system or an origin, systems that PROJ does not know, and planes that are not in metres.
/// Coordinates without system that do not look like degrees (io/text/floe_text.hpp) are metres of the plane.
tl::expected<PlaneReport, PlaneError> bring_to_plane(std::vector<SourceFloe>& floes, const std::string& crs,
                                                     const PlaneSettings& settings);

}  // namespace polynya::io
