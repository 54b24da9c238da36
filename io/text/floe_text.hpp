#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_parser.hpp"
#include "io/text/json_writer.hpp"
#include "io/text/source_text.hpp"
#include "simulation/world/scene.hpp"

namespace polynya::io {

/// Longest text of floes that is read [bytes]; longer ones are refused. It limits the memory that a wrong file can
/// take. A larger limit must stay below 4 GiB, because offsets in texts have 32 bits; a smaller one refuses files of
/// large ice charts.
inline constexpr std::size_t kLongestFloeText = std::size_t{256} << 20;

/// Format in which a text of floes is written: one GeoJSON value, one GeoJSON value per line (NDJSON), or WKT
/// geometries.
enum class FloeFormat { kGeojson, kNdjson, kWkt };

/// One polygon of a text as it is written there, or the reason why there is none.
struct FloeEntry {
  /// Rings as drawn, in the coordinates of the file: in either direction, closed or open; NaN in place of a missing
  /// number. It is not checked for crossings.
  geometry::Polygon polygon;
  std::size_t feature = 0;              ///< number of the feature, line or WKT geometry that has the polygon, from 0
  std::size_t member = 0;               ///< number of the polygon in its feature, from 0
  std::uint32_t offset = 0;             ///< position of the polygon in the text [bytes]
  std::size_t line = 1;                 ///< line in the text at which the polygon begins, from 1
  std::optional<std::int64_t> floe_id;  ///< property "floe_id", if it is a number that floe_id_in() accepts
  std::optional<std::string> other_id;  ///< otherwise that property, or the "id" of the feature: JSON as written
  /// Properties of the feature except `own_properties`, as members of a JSON object without its braces; null: none.
  /// Import and cut copy them to each piece of the floe. Polygons of one feature share them.
  std::shared_ptr<const std::string> properties;
  /// Likewise: floe_id, parent_id, area_m2 and part, which Polynya writes anew for each piece and does not copy.
  /// Conditions that select features may use them too.
  std::shared_ptr<const std::string> own_properties;
  /// Kind of the reason why there is no polygon: "not-a-polygon", "no-geometry", "malformed" or "syntax"; empty: there
  /// is one.
  std::string refusal;
  std::string detail;  ///< explanation of the refusal for the message: "found Point, expected …"; empty: none needed
};

/// Place on the Earth of the plane of a file that Polynya wrote. Such a file states it in members of its own, because
/// GeoJSON has none for a plane about a place or a shifted system. Thanks to them it is read back to the same place.
struct StatedPlace {
  std::optional<simulation::GeographicOrigin> origin;  ///< "origin": the plane is the one about this place
  /// "shifted_crs": the plane is that of this coordinate system, shifted; empty: it has no such member
  std::string shifted_crs;
  geometry::Vector shift;  ///< "shift_m": vector that was added to the coordinates in that system [m]
  std::string wrong;       ///< message if such a member cannot be read, which refuses the file; empty: all can

  /// Returns true if the file states its place.
  bool is_stated() const { return origin || !shifted_crs.empty(); }
};

/// Writes the place as members of the JSON object that is open; writes nothing if no place is stated.
void write_place(JsonWriter& json, const StatedPlace& place);

/// Returns the members for a plane about an origin as JSON, as a GeojsonLayer takes them; empty if there is no origin.
std::string place_members(const std::optional<simulation::GeographicOrigin>& origin);

/// Converts radians to degrees and rounds them to 1e-12°, which removes the rounding of the conversion: 15, not
/// 14.999999999999998.
double degrees_in_file(double radians);

/// A text of floes after it was read.
struct FloeText {
  FloeFormat format = FloeFormat::kGeojson;
  std::vector<FloeEntry> entries;     ///< in the order of the text
  bool has_more_coordinates = false;  ///< true if points have Z or M values, which are ignored
  bool has_srid = false;              ///< true if the WKT has "SRID=…;"
  std::string srid;                   ///< coordinate system that the last SRID names: "EPSG:3413"; empty: it names none
  std::string crs;  ///< member "crs" of GeoJSON as JSON (in the format of 2008; RFC 7946 has none); may be empty
  bool has_other_crs = false;  ///< true if several members "crs", or several SRIDs, differ; `crs` is the first
  std::optional<double> time;  ///< member "t_s" of GeoJSON, the time of the run that wrote the file [s]
  /// Σ of the property area_m2 of the features [m²]. If it equals the area of the coordinates, these are metres.
  double stated_area = 0;
  StatedPlace place;  ///< place on the Earth that a file of Polynya states
};

/// Reads the polygons of a text: GeoJSON (Polygon, MultiPolygon, Feature, FeatureCollection, GeometryCollection),
/// NDJSON (one of these per line) or WKT. The format is recognised by the content. '#' and '//' begin comments. A text
/// without content has no polygons. Anything that is not a polygon, such as a bad line of NDJSON or WKT, becomes an
/// entry with the reason why it is refused, and reading continues after it. The polygons are not checked for crossings.
/// Fails with "line:column: words" if the text cannot be read at all: one that begins as JSON and is none, one in none
/// of the formats, or one longer than kLongestFloeText.
Result<FloeText> read_floe_text(std::string text);

/// Reads the polygons of one GeoJSON value in the same way, but with no properties except floe_id, and without "crs",
/// because these are copied from a text. Lines of entries are 1.
FloeText read_floe_json(const JsonValue& geojson);

/// Appends "POLYGON ((…), (…))" with numbers that read back to the same doubles.
void append_wkt(std::string& text, const geometry::Polygon& polygon);

/// Returns true if a text may be in one of these formats: its first line that is neither blank nor a comment begins as
/// one of them, or there is no such line. The beginning of a text is enough.
bool may_be_floe_text(std::string_view text);

/// Returns the id of a floe from the member `key` of an object. Returns nothing if there is no such member, or if it is
/// not a whole number from 0 to below 9e15, up to which doubles represent all whole numbers.
std::optional<std::int64_t> floe_id_in(const JsonValue& object, std::string_view key);

/// Returns the name of the coordinate system in a GeoJSON member "crs" (FloeText::crs), for find_crs(). A number
/// becomes "EPSG:n". Returns "" if the member names no system, and for an empty text.
std::string crs_name(const std::string& crs);

/// Returns the coordinate system that a text names by "crs", or if it has none by SRID, for find_crs(); empty if it
/// names none. StatedPlace is not used.
std::string system_of(const FloeText& text);

/// Returns true if a point may be a longitude (x) and a latitude (y) [°]; false for NaN. Longitudes up to a turn beyond
/// ±180 are accepted, because floes across longitude 180 may be drawn with them.
bool is_in_degrees(geometry::Point point);

/// Evidence from coordinates alone whether they are degrees, for files that name no coordinate system. If such a file
/// looks like degrees, an import with an origin or a target system projects it, and any other import refuses it, since
/// it would otherwise be read as ice of a few metres. A few wrong numbers in a file do not hide the rest.
struct CoordinateEvidence {
  geometry::Box box{};        ///< box around the floes in the range of degrees, without vertices outside of it
  double area = 0;            ///< Σ of the areas of these floes (outer rings), in squares of their unit
  std::size_t floes = 0;      ///< number of floes with an outline
  std::size_t in_range = 0;   ///< number of floes with most of their vertices in the range of degrees
  bool are_all_whole = true;  ///< true if no floe in range has a vertex outside of it

  /// Adds a floe, with its vertices as drawn.
  void add(const geometry::Polygon& polygon);
  /// Returns true if the floes look like polar ice in degrees: most are in the range of degrees, all of these on one
  /// side beyond 40° of latitude, and they cover less than 100 square degrees (one is 3000 km² at 75°).
  bool look_polar() const;
  /// Returns true if the floes look like degrees, polar or not. Besides polar ice, floes at any latitude do if all
  /// their vertices are in the range of degrees and they cover less than one square of the unit. If the unit were
  /// metres, that would be less than 1 m², which is no ice to simulate.
  bool look_like_degrees() const;
};

}  // namespace polynya::io
