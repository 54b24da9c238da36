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

/// What a file's coordinates show without its crs.
struct CoordinateEvidence {
  geometry::Box box{};
  double area = 0;  ///< Σ of the floes, in squares of the unit they are in
  bool is_empty = true;

  void add(const geometry::Polygon& polygon);
  /// All lie on one side beyond 40 of latitude, in the range of degrees, and cover less than 100 squares,
  /// which are 3000 km² each at 75°.
  bool look_polar() const;
  /// Or they cover less than one square at any latitude: no ice to simulate if it is in m².
  bool look_like_degrees() const;
};

/// The command that projects a file's coordinates from degrees to metres around the middle of their box.
std::string how_to_project(const geometry::Box& box_in_degrees, const std::string& file);

}  // namespace polynya::io
