#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/json_value.hpp"
#include "io/text/result.hpp"

namespace polynya::io {

inline constexpr std::size_t kLongestFloeText = std::size_t{256} << 20;  ///< [bytes]

/// How a text of floes is written.
enum class FloeFormat { kGeojson, kNdjson, kWkt };

/// A polygon as it stands in a text, or what stands there in place of one.
struct FloeEntry {
  geometry::Polygon polygon;            ///< rings as drawn: either way round, closed or not; NaN where no number stands
  std::size_t feature = 0;              ///< which feature, line or WKT geometry of the text, from 0
  std::size_t member = 0;               ///< which polygon of it, from 0
  std::size_t line = 1;                 ///< in the text, from 1
  std::optional<std::int64_t> floe_id;  ///< its property of that name
  std::shared_ptr<const std::string> properties;  ///< the feature's others, as members of JSON; null if none
  std::string refusal;                            ///< "not-a-polygon", "no-geometry", "malformed", "syntax", or empty
  std::string detail;                             ///< for people
};

struct FloeText {
  FloeFormat format = FloeFormat::kGeojson;
  std::vector<FloeEntry> entries;     ///< in the order of the text
  bool has_more_coordinates = false;  ///< Z or M values were passed over
  bool has_srid = false;              ///< "SRID=…;" was passed over
  std::string crs;                    ///< GeoJSON's member of that name (of 2008; RFC 7946 has none), JSON; or empty
  bool has_other_crs = false;         ///< several differ; `crs` is the first
};

/// Reads the polygons of a text: GeoJSON (Polygon, MultiPolygon, Feature, FeatureCollection,
/// GeometryCollection), NDJSON (one of these a line; also a run's floes.ndjson) or WKT, distinguished by the
/// content. A text without content has no polygons. What is no polygon, a bad line of NDJSON or WKT among
/// them, is an entry with its refusal; validity is not checked. The error is for a text that cannot be read
/// at all: "line:column: words".
Result<FloeText> read_floe_text(std::string text);

/// The polygons of one GeoJSON value, likewise.
FloeText read_floe_json(const JsonValue& geojson);

/// The number of a floe in a member of an object; nothing where that is no such number.
std::optional<std::int64_t> floe_id_in(const JsonValue& object, std::string_view key);

}  // namespace polynya::io
