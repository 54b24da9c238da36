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

// Polynya itself reads only GeoJSON, NDJSON and WKT. GDAL's programs (Debian's gdal-bin) read all other formats, select
// features, know coordinate systems and project coordinates. Functions of this header that return a Result run these
// programs as child processes. They fail with a message that names the package if a program is missing.

/// Name by which GDAL knows the system of longitude and latitude on WGS 84 in degrees, longitude first. Degrees in
/// files that name no system are taken to be in it.
inline constexpr const char* kDegreesOnEarth = "OGC:CRS84";

/// Properties of a coordinate reference system. If none of the three flags is set, Polynya cannot use coordinates in
/// it; an example is a geocentric system. Of a system with heights, they describe the horizontal part.
struct Crs {
  std::string name;            ///< "WGS 84 / NSIDC Sea Ice Polar Stereographic North"
  std::string code;            ///< "EPSG:3413"; empty if the definition has no code; equal codes are one system
  bool is_geographic = false;  ///< coordinates are longitude and latitude in degrees
  bool is_projected = false;   ///< coordinates lie in a plane, in any unit of length
  bool is_metric = false;      ///< coordinates lie in a plane and are in metres
};

/// Returns the name of a system for messages: the name in WKT, or else the definition, shortened to 100 bytes.
std::string name_of_system(const std::string& definition);

/// Looks a system up in PROJ's database. The definition is a code ("EPSG:3413", "urn:ogc:def:crs:OGC:1.3:CRS84"), a
/// PROJ string or WKT. Fails if PROJ does not know it. A definition that is empty, that names a file or a web address
/// (other than those of opengis.net/def/crs/), or that GDAL would take for an option, is refused in the same way,
/// because the text may come from somebody else's file.
Result<Crs> find_crs(const std::string& definition);

/// Returns true if both coordinates are finite numbers. transform() marks points without an image by NaN.
inline bool is_finite(geometry::Point p) {
  return std::isfinite(p.x) && std::isfinite(p.y);
}

/// Transforms points from one coordinate system to another (gdaltransform). Returns the image of each point, in the
/// same order. x is east or longitude and y is north or latitude, whatever axis order the authority of the system
/// defines, both in the unit of the system [° or m]. The image of a point is NaN if the target system cannot show it,
/// or if the point is not finite. Fails if GDAL rejects a system. Without a finite point GDAL is not started.
Result<std::vector<geometry::Point>> transform(const std::vector<geometry::Point>& points, const std::string& from,
                                               const std::string& to);

/// The features of a file that a user selects.
struct Selection {
  std::string layer = {};  ///< layer of a file that has several; empty: the only one with polygons
  std::string where = {};  ///< condition on the properties in the SQL of OGR: "POLY_TYPE = 'I'"; empty: all features
  /// How a user names a layer, for the message that asks for one. It is the option of the command line; readers of
  /// scenes set the scene's key instead.
  std::string layer_in_words = "--layer NAME";
};

/// A file that GDAL has converted.
struct ForeignFile {
  std::string geojson;  ///< selected features as GeoJSON, in the coordinates of the file
  std::string system;   ///< coordinate system of the layer as WKT; empty: it has none
  /// Sentences for the user: how many features were selected, which of several layers was read, and that third
  /// coordinates were left out. Empty if there is nothing to say.
  std::vector<std::string> notes;
};

/// Reads a file in a format that GDAL knows (ogrinfo, ogr2ogr), also within a .zip archive, or a folder if the format
/// is one of folders. Curves become lines, and third coordinates are left out. Returns nothing, and applies no
/// selection, if the caller must read the file as GeoJSON, NDJSON or WKT: it begins as one of these, it is a text that
/// begins as none of them and that GDAL does not know either (or GDAL is missing), or it is a pipe, a device or a file
/// that cannot be opened. TopoJSON and Esri's JSON are left to GDAL. Fails if GDAL cannot read a folder, XML or a file
/// that is no text, if no layer has the name in the selection, if none is named and several layers have polygons or
/// none has (the message lists the layers), and if the GeoJSON would be longer than `longest` [bytes].
std::optional<Result<ForeignFile>> read_foreign_file(const std::filesystem::path& file, const Selection& selection,
                                                     std::size_t longest);

/// Applies a condition on properties (Selection::where) to a text that Polynya itself has read (ogr2ogr). Polygons of
/// features that do not satisfy the condition are removed. Entries that could not be read as a feature (refusal
/// "syntax") stay, so that they are reported later. Returns a message that says how many features were selected; it is
/// no error if none were. Fails for WKT, which has no properties, and if GDAL rejects the condition or is missing;
/// `floes` is then unchanged.
Result<std::string> select_features(FloeText& floes, const std::string& where);

}  // namespace polynya::io
