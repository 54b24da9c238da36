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

inline constexpr std::size_t kLongestFloeText = std::size_t{256} << 20;  ///< [bytes]

/// How a text of floes is written.
enum class FloeFormat { kGeojson, kNdjson, kWkt };

/// A polygon as it stands in a text, or what stands there in place of one.
struct FloeEntry {
  geometry::Polygon polygon;            ///< rings as drawn: either way round, closed or not; NaN where no number stands
  std::size_t feature = 0;              ///< which feature, line or WKT geometry of the text, from 0
  std::size_t member = 0;               ///< which polygon of it, from 0
  std::uint32_t offset = 0;             ///< of it in the text
  std::size_t line = 1;                 ///< likewise, from 1
  std::optional<std::int64_t> floe_id;  ///< its property of that name, where that is a whole number
  std::optional<std::string> other_id;  ///< else what stands there, or the feature's "id": a value of JSON, as written
  std::shared_ptr<const std::string> properties;  ///< the feature's others, as members of JSON; null if none
  std::shared_ptr<const std::string>
      own_properties;   ///< likewise: floe_id, and what Polynya writes of each floe itself
  std::string refusal;  ///< "not-a-polygon", "no-geometry", "malformed", "syntax", or empty
  std::string detail;   ///< for people
};

/// What a file that Polynya wrote states of the place of its plane on the Earth, in members of its own.
struct StatedPlace {
  std::optional<simulation::GeographicOrigin> origin;  ///< "origin": the plane is that about this place
  std::string shifted_crs;                             ///< "shifted_crs": else the plane is that of this system
  geometry::Vector shift;                              ///< "shift_m": that was added to the coordinates there [m]
  std::string wrong;                                   ///< in words, where such a member cannot be read

  bool is_stated() const { return origin || !shifted_crs.empty(); }
};

/// Writes it as members of the object at hand; nothing where none is stated.
void write_place(JsonWriter& json, const StatedPlace& place);

/// The same members as JSON, for a GeojsonLayer; empty where there is no origin.
std::string place_members(const std::optional<simulation::GeographicOrigin>& origin);

/// An angle in degrees, without the rounding of its conversion: 15, not 14.999999999999998.
double degrees_in_file(double radians);

struct FloeText {
  FloeFormat format = FloeFormat::kGeojson;
  std::vector<FloeEntry> entries;     ///< in the order of the text
  bool has_more_coordinates = false;  ///< Z or M values were passed over
  bool has_srid = false;              ///< WKT has "SRID=…;"
  std::string srid;                   ///< then the system that it names, "EPSG:3413"; empty: none
  std::string crs;                    ///< GeoJSON's member of that name (of 2008; RFC 7946 has none), JSON; or empty
  bool has_other_crs = false;         ///< several differ; `crs` is the first
  std::optional<double> time;         ///< GeoJSON's member "t_s", which a run writes beside its floes [s]
  double stated_area = 0;             ///< Σ of the features' area_m2 [m²]
  StatedPlace place;                  ///< what a file that Polynya wrote states of its plane
};

/// Reads the polygons of a text: GeoJSON (Polygon, MultiPolygon, Feature, FeatureCollection,
/// GeometryCollection), NDJSON (one of these a line) or WKT, distinguished by the content. A text without content has
/// no polygons. What is no polygon, a bad line of NDJSON or WKT among them, is an entry with its refusal; validity is
/// not checked. The error is for a text that cannot be read at all: "line:column: words".
Result<FloeText> read_floe_text(std::string text);

/// The polygons of one GeoJSON value, likewise.
FloeText read_floe_json(const JsonValue& geojson);

/// Appends "POLYGON ((…), (…))" with numbers that read back to the same doubles.
void append_wkt(std::string& text, const geometry::Polygon& polygon);

/// Whether a text may be one of these formats: its first line that is neither blank nor a comment begins as one, or it
/// has none.
bool may_be_floe_text(std::string_view text);

/// The number of a floe in a member of an object; nothing where that is no such number.
std::optional<std::int64_t> floe_id_in(const JsonValue& object, std::string_view key);

/// The name that a GeoJSON crs member (FloeText::crs) gives its system; "" where it gives none.
std::string crs_name(const std::string& crs);

/// The coordinate system that a text names, by its crs member or its SRID; or empty.
std::string system_of(const FloeText& text);

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

}  // namespace polynya::io
