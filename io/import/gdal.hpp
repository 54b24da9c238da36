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

// Polynya reads only GeoJSON, NDJSON and WKT. GDAL's programs (Debian's gdal-bin) read all other formats, select
// features, know coordinate systems and project coordinates. Each function of this header runs one of these programs as
// a child process. It fails with a message that names the package if the program is missing.

/// Longitude and latitude on WGS 84 in degrees, longitude first.
inline constexpr const char* kDegreesOnEarth = "OGC:CRS84";

/// A coordinate reference system.
struct Crs {
  std::string name;            ///< "WGS 84 / NSIDC Sea Ice Polar Stereographic North"
  std::string code;            ///< "EPSG:3413"; may be empty
  bool is_geographic = false;  ///< coordinates are longitude and latitude in degrees
  bool is_projected = false;   ///< coordinates lie in a plane
  bool is_metric = false;      ///< coordinates lie in a plane and are in metres
};

/// Returns the name of a system for messages: the name in WKT, or else the definition.
std::string name_of_system(const std::string& definition);

/// Looks a system up in PROJ's database. The definition is a code ("EPSG:3413", "urn:ogc:def:crs:OGC:1.3:CRS84"), a
/// PROJ string or WKT. A definition that names a file or a web address is refused, because the text may come from
/// somebody else's file.
Result<Crs> find_crs(const std::string& definition);

inline bool is_finite(geometry::Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Transforms points to another coordinate system, in their order (gdaltransform). x is east or longitude [°], whatever
/// order the authority of the system defines. A point that has no image, or is not finite, becomes NaN.
Result<std::vector<geometry::Point>> transform(const std::vector<geometry::Point>& points, const std::string& from,
                                               const std::string& to);

/// Selects features of a file.
struct Selection {
  std::string layer = {};  ///< layer of a file that has several; empty: the only one with polygons
  std::string where = {};  ///< condition on the properties in the SQL of OGR: "POLY_TYPE = 'I'"; empty: all features
  std::string layer_in_words = "--layer NAME";  ///< how a user names a layer, for messages
};

/// A file that GDAL has read.
struct ForeignFile {
  std::string geojson;             ///< selected features in the coordinates of the file
  std::string system;              ///< coordinate system of the layer as WKT; empty: it has none
  std::vector<std::string> notes;  ///< messages about what was selected
};

/// Reads a file in a format that GDAL knows (ogrinfo, ogr2ogr). Curves become lines, and third coordinates are left
/// out. Returns nothing if the file is to be read as GeoJSON, NDJSON or WKT, because it begins as one of these, or
/// because GDAL does not know its format either. Fails if the file has several layers and none is named (the message
/// lists them), and if its text would be longer than `longest` [bytes].
std::optional<Result<ForeignFile>> read_foreign_file(const std::filesystem::path& file, const Selection& selection,
                                                     std::size_t longest);

/// Removes the polygons of features that do not satisfy a condition on their properties (Selection::where). Returns a
/// message on how many features were selected. Entries that could not be read as a feature stay, so that they are
/// reported.
Result<std::string> select_features(FloeText& floes, const std::string& where);

}  // namespace polynya::io
