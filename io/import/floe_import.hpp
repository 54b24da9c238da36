#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "io/import/plane.hpp"
#include "io/text/floe_ids.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::io {

/// What is done to the floes of a file.
struct ImportSettings {
  PlaneSettings plane;
  /// Polygons of one feature, and those on both sides of longitude 180, whose boundaries run along each other within
  /// this distance are joined, and slits that are narrower are closed [m]. With 0 nothing is joined.
  double join = 0;
  std::optional<geometry::FillRule> repair;  ///< of outlines that are not valid; none: they are refused
  double simplify = 0;                       ///< how far a vertex that is left out may lie from the rest [m]
  double least_area = 0;                     ///< smaller floes are dropped [m²]
  double gap = 0;                            ///< least distance between floes [m]
};

/// A floe in the plane; several may be of one floe of the file.
struct ImportedFloe {
  geometry::Polygon polygon;  ///< valid, in house notation [m]
  std::size_t source = 0;     ///< index in the file's floes
};

/// What happened to a floe of the file that is not as it was read. Areas in m².
struct ImportItem {
  std::size_t source = 0;
  std::string refused;                                  ///< why; empty: it was not
  bool is_outline_refused = false;                      ///< for its outline, which a repair may make valid
  std::vector<std::size_t> joined;                      ///< with these, of which it is the first
  std::optional<std::size_t> joined_to;                 ///< it has become part of this one
  bool is_closed = false;                               ///< a slit in it was closed
  double joined_area = 0;                               ///< area that joining or closing a slit added
  std::string defect;                                   ///< of its outline, repaired; empty: it had none
  double repaired = 0;                                  ///< area that the repair added
  std::size_t vertices_before = 0, vertices_after = 0;  ///< of a simplified outline; equal: it was not
  double simplified = 0;                                ///< area that leaving out vertices added
  double trimmed = 0;                                   ///< area that went to larger floes, or to the gap
  std::vector<std::size_t> yields;                      ///< to these, by their index in the file
  double dropped = 0;                                   ///< area of its pieces below the least area
  std::size_t dropped_pieces = 0;
  double area_before = 0;  ///< as read, in the plane; of a refused one 0
  double area_after = 0;
  std::size_t pieces = 0;  ///< it became
};

/// Counts of floes of the file, and sums that are computed exactly and rounded once each [m²].
struct ImportTotals {
  std::size_t read = 0, joined = 0, refused = 0, repaired = 0, simplified = 0, trimmed = 0, dropped = 0, written = 0;
  std::size_t with_thickness = 0;  ///< of their own, of those written
  double area_read = 0;            ///< of all that were not refused
  double area_joined = 0, area_repaired = 0, area_simplified = 0, area_trimmed = 0, area_dropped = 0;
  double area_written = 0;
  double area_change = 0;  ///< written − read
};

struct ImportOutcome {
  std::vector<ImportedFloe> floes;  ///< by source
  std::vector<ImportItem> items;    ///< of those that did not stay as they were, by source
  PlaneReport plane;
  ImportTotals totals;
};

/// The floes of a text with what their features state of them.
struct FloesOfText {
  std::vector<SourceFloe> floes;  ///< refused where anything is wrong with them before their outlines are inspected
  std::vector<NearMiss> near_misses;
  std::vector<std::string> notes;  ///< what was read otherwise than it stands in the file, in words
  std::optional<double> run_time;  ///< where they are those of a run at that time [s]
};
FloesOfText floes_of(const FloeText& text, const PropertyRules& rules);

/// Brings floes to the plane, repairs or refuses outlines that are not valid, simplifies them, and takes
/// overlaps from the smaller of two (geometry/cut/overlap.hpp). The floes' properties are left in `floes`.
tl::expected<ImportOutcome, PlaneError> import_floes(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const ImportSettings& settings);

/// The ids of imported floes.
struct ImportedIds {
  std::vector<std::int64_t> ids;                  ///< of each imported floe
  std::vector<std::optional<std::string>> other;  ///< what the file calls it, where it has another id: JSON
  std::string key;                                ///< the property of that
  std::string note;                               ///< why ids of the file were not kept, in words; or empty
};
ImportedIds ids_of(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                   const std::vector<FloeEntry>& entries);

/// The imported floes as GeoJSON in metres, with the properties of the features they are of: `entries` are
/// those of the file, one for each of its floes.
std::string to_geojson(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                       const std::vector<FloeEntry>& entries, const ImportedIds& ids);

/// The report of an import as JSON: totals, how the coordinates came to the plane, and each floe that did not
/// stay as it was (docs/import.md).
std::string to_json_text(const ImportOutcome& imported, const std::string& file, const std::vector<FloeEntry>& entries,
                         const FloesOfText& read, const std::vector<std::string>& notes);

/// "812 floes read, 3 repaired, 12 trimmed, 2 dropped, 1 refused; 809 written"
std::string counts_in_words(const ImportTotals& totals);

/// "2 of 3 floes have a thickness of their own"
std::string thickness_in_words(std::size_t with_thickness, std::size_t floes);

/// "123.4 m² read + 0.5 repaired − 3 trimmed − 1 dropped = 119.9 m² written"
std::string areas_in_words(const ImportTotals& totals);

/// How the coordinates came to the plane: "WGS 84, projected about 78.2, 15.6"
std::string plane_in_words(const PlaneReport& plane);

/// What happened to a floe: "self-crossing at (0, 0), repaired, +3 m²; trimmed, −2 m² to feature 3"
std::string item_in_words(const ImportItem& item, const std::vector<FloeEntry>& entries);

}  // namespace polynya::io
