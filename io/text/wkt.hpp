#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_parser.hpp"

namespace polynya::io {

inline constexpr std::string_view kBlanks = " \t\r\n";

/// A line without the blanks around it.
std::string_view trimmed(std::string_view line);

/// Whether a trimmed line begins with the name of a geometry, or with any word that a bracket follows.
bool begins_wkt(std::string_view line);

/// One geometry of a WKT text, or what is wrong with it.
struct WktGeometry {
  JsonValue geojson;         ///< the same as GeoJSON; a coordinate may be NaN or infinite
  std::uint32_t offset = 0;  ///< of its first byte
  bool has_srid = false;     ///< "SRID=…;", passed over
  std::string error;         ///< of its syntax; or empty
};

/// The geometries of a text, in order: any case, with or without Z and M, "SRID=…;" before and ";" behind passed
/// over, '#' and '//' comments to the line's end. After a syntax error reading continues at the next line.
std::vector<WktGeometry> read_wkt(std::string_view text);

/// Appends "POLYGON ((…), (…))" with numbers that read back to the same doubles.
void append_wkt(std::string& text, const geometry::Polygon& polygon);

}  // namespace polynya::io
