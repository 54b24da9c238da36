#pragma once

#include <cmath>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/point.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

// GDAL's programs (Debian's gdal-bin) read every format but GeoJSON, NDJSON and WKT, filter features, know coordinate
// systems and project. Each function of this header runs one of them as a child process, and fails with a message that
// names the package where the program is missing.

/// Longitude and latitude on WGS 84 in degrees, longitude first.
inline constexpr const char* kDegreesOnEarth = "OGC:CRS84";

/// A coordinate reference system.
struct Crs {
  std::string name;            ///< "WGS 84 / NSIDC Sea Ice Polar Stereographic North"
  std::string code;            ///< "EPSG:3413"; or empty
  bool is_geographic = false;  ///< longitude and latitude in degrees
  bool is_projected = false;   ///< a plane
  bool is_metric = false;      ///< a plane in metres
};

/// What a definition is called in messages: the name in WKT, else the definition.
std::string name_of_system(const std::string& definition);

/// Returns what PROJ's database has of a system: "EPSG:3413", "urn:ogc:def:crs:OGC:1.3:CRS84", a PROJ string or WKT. A
/// definition that names a file or an address of the web is refused.
Result<Crs> find_crs(const std::string& definition);

inline bool is_finite(geometry::Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Returns the points in another coordinate system, in their order (gdaltransform). x is east or longitude [°] first,
/// whatever order the system's authority has. A point that has no image, or is not finite, becomes NaN.
Result<std::vector<geometry::Point>> transform(const std::vector<geometry::Point>& points, const std::string& from,
                                               const std::string& to);

/// Which features of a file are taken.
struct Selection {
  std::string layer = {};  ///< of a file with several; empty: the only one with polygons
  std::string where = {};  ///< a condition on their properties in the SQL of OGR: "POLY_TYPE = 'I'"; empty: all of them
  std::string layer_in_words = "--layer NAME";  ///< how a user names a layer, in messages
};

/// A file that GDAL has read.
struct ForeignFile {
  std::string geojson;             ///< the features that were selected, in the file's coordinates
  std::string system;              ///< the coordinate system of the layer, as WKT; empty: it has none
  std::vector<std::string> notes;  ///< for people: what was selected
};

/// Reads a file of a format that GDAL knows (ogrinfo, ogr2ogr); curves become lines, third coordinates are left out.
/// Returns nothing where the file is to be read as GeoJSON, NDJSON or WKT, because it begins as one of these, or
/// because GDAL does not know its format either. Fails where the file has several layers and none of them is named,
/// with their names, and where its text would be longer than `longest` [bytes].
std::optional<Result<ForeignFile>> read_foreign_file(const std::filesystem::path& file, const Selection& selection,
                                                     std::size_t longest);

/// Removes the polygons of features that do not meet a condition on their properties (Selection::where), and returns in
/// words how many features were taken. What could not be read as a feature stays, so that it is reported.
Result<std::string> select_features(FloeText& floes, const std::string& where);

}  // namespace polynya::io
