#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/import/floe_properties.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

struct PJconsts;  // PROJ's PJ
struct pj_ctx;    // and PJ_CONTEXT

namespace polynya::io {

/// A place on WGS 84.
struct Geographic {
  double latitude = 0;   ///< [rad]
  double longitude = 0;  ///< [rad]; continuous around the origin's, so it may leave ±π
};

/// A coordinate reference system as PROJ knows it.
struct Crs {
  std::string name;            ///< "WGS 84 / NSIDC Sea Ice Polar Stereographic North"
  bool is_geographic = false;  ///< longitude and latitude in degrees
  bool is_projected = false;   ///< a plane
  bool is_metric = false;      ///< of metres
};

/// What PROJ knows of a system: "EPSG:3413", "urn:ogc:def:crs:OGC:1.3:CRS84", a PROJ string or WKT.
Result<Crs> find_crs(const std::string& definition);

/// Coordinates of one system in another, by PROJ. x is east or longitude [°] first, whatever order the
/// system's authority has.
class Projection {
 public:
  static Result<Projection> between(const std::string& from, const std::string& to);

  /// All of them at once; what has no image becomes NaN.
  void apply(std::vector<geometry::Point>& points) const;
  void apply_inverse(std::vector<geometry::Point>& points) const;

 private:
  struct Free {
    void operator()(PJconsts* object) const;
    void operator()(pj_ctx* context) const;
  };
  Projection() = default;
  std::unique_ptr<pj_ctx, Free> context_;
  std::unique_ptr<PJconsts, Free> steps_;
  friend Result<Crs> find_crs(const std::string& definition);
};

/// The scene's plane about a place on WGS 84: azimuthal equidistant (PROJ's aeqd) with its x axis turned to
/// the origin's heading. Distances and directions from the origin are exact; across them lengths are right to
/// d²/(6 R²) of themselves, d from the origin: 4 mm over 10 km.
class GeographicPlane {
 public:
  /// Fails where PROJ cannot be loaded.
  static Result<GeographicPlane> about(const simulation::GeographicOrigin& origin);

  Geographic geographic_of(geometry::Point point) const;
  /// From degrees, longitude first.
  void place(std::vector<geometry::Point>& degrees) const;
  /// From coordinates of the system named by system().
  void turn(std::vector<geometry::Point>& east_north) const;

  /// The plane with x east and y north, as a PROJ string.
  static std::string system(const simulation::GeographicOrigin& origin);

 private:
  GeographicPlane(const simulation::GeographicOrigin& origin, Projection from_degrees)
      : origin_(origin), from_degrees_(std::move(from_degrees)) {}

  simulation::GeographicOrigin origin_;
  Projection from_degrees_;
};

inline constexpr double kFarthestFloe = 1e6;  ///< a coordinate in the plane [m]

/// A floe as a file has it.
struct SourceFloe {
  geometry::Polygon polygon;  ///< rings as drawn, in the file's coordinates
  FloeProperties properties;
  std::string refused = {};  ///< why it is; empty: it is not
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
