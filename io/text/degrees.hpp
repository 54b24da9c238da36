#pragma once

#include <string>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_value.hpp"

namespace polynya::io {

/// The name that a GeoJSON crs member gives its system; "" where it gives none.
std::string crs_name(const JsonValue& crs);

/// The name of a GeoJSON crs member (of 2008; RFC 7946 has none) that is in longitude and latitude, "" for
/// every other: those are taken to be metres.
std::string geographic_crs(const JsonValue& crs);

/// Whether a point may be a longitude and a latitude: one turn more or less names the same meridian.
bool is_in_degrees(geometry::Point point);

/// What a file's coordinates show without its crs. A wrong number here and there does not hide the rest.
struct CoordinateEvidence {
  geometry::Box box{};        ///< of the floes in the range of degrees, without vertices that are not
  double area = 0;            ///< Σ of these floes, in squares of the unit they are in
  std::size_t floes = 0;      ///< with an outline
  std::size_t in_range = 0;   ///< of them with most of their vertices in the range of degrees
  bool are_all_whole = true;  ///< all of their vertices are

  void add(const geometry::Polygon& polygon);
  /// Most floes lie on one side beyond 40 of latitude, in the range of degrees, and cover less than 100
  /// squares, which are 3000 km² each at 75°.
  bool look_polar() const;
  /// Or all are in the range of degrees and cover less than one square at any latitude: no ice to simulate if
  /// it is in m².
  bool look_like_degrees() const;
};

/// The command that projects a file's coordinates from degrees to metres around the middle of their box.
std::string how_to_project(const geometry::Box& box_in_degrees, const std::string& file);

}  // namespace polynya::io
