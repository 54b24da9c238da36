#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "geometry/shape/point.hpp"
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

}  // namespace polynya::io
