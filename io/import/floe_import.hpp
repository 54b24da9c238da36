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

/// Settings of an import: what is changed in the floes of a file.
struct ImportSettings {
  PlaneSettings plane;
  /// Polygons of one feature, and polygons on both sides of longitude 180, are joined if their boundaries are within
  /// this distance of each other [m]. Slits narrower than this are closed. With 0 nothing is joined.
  double join = 0;
  /// Rule by which outlines that are not valid are repaired; none: they are refused.
  std::optional<geometry::FillRule> repair;
  /// Largest distance of a vertex that is left out from the simplified outline [m]; 0: outlines stay.
  double simplify = 0;
  double least_area = 0;  ///< floes with less area are dropped [m²]
  double gap = 0;         ///< least distance between floes [m]; the smaller floe of two is trimmed to it
};

/// A floe in the plane. One floe of the file may become several.
struct ImportedFloe {
  geometry::Polygon polygon;  ///< valid, in house notation [m]
  std::size_t source = 0;     ///< index of its floe in the file
};

/// Changes of one floe of the file. Only floes that changed have one. All areas are in m².
struct ImportItem {
  std::size_t source = 0;
  std::string refused;                   ///< reason why it was refused; empty: it was not
  bool is_outline_refused = false;       ///< true if it was refused for its outline, which a repair may make valid
  std::vector<std::size_t> joined;       ///< floes of the file that were joined to this one, the first of them
  std::optional<std::size_t> joined_to;  ///< floe of the file to which this one was joined
  bool is_closed = false;                ///< true if a slit in it was closed
  double joined_area = 0;                ///< area that joining, or closing a slit, added
  std::string defect;                    ///< fault of its outline, which was repaired; empty: it had none
  double repaired = 0;                   ///< area that the repair added
  /// Numbers of vertices before and after simplifying; equal: none was left out.
  std::size_t vertices_before = 0, vertices_after = 0;
  double simplified = 0;            ///< area that leaving out vertices added
  double trimmed = 0;               ///< area that was given to larger floes and to the gap
  std::vector<std::size_t> yields;  ///< floes of the file to which it gave area
  double dropped = 0;               ///< area of its pieces that are smaller than the least area
  std::size_t dropped_pieces = 0;
  double area_before = 0;  ///< area as read, in the plane; 0 if it was refused
  double area_after = 0;
  std::size_t pieces = 0;  ///< number of floes that it became
};

/// Counts of floes of the file, and sums of areas. Each sum is computed exactly and rounded once [m²].
struct ImportTotals {
  std::size_t read = 0, joined = 0, refused = 0, repaired = 0, simplified = 0, trimmed = 0, dropped = 0, written = 0;
  std::size_t with_thickness = 0;  ///< floes among those written that have their own thickness
  double area_read = 0;            ///< of all floes that were not refused
  double area_joined = 0, area_repaired = 0, area_simplified = 0, area_trimmed = 0, area_dropped = 0;
  double area_written = 0;
  double area_change = 0;  ///< written − read
};

struct ImportOutcome {
  std::vector<ImportedFloe> floes;  ///< in the order of their sources
  std::vector<ImportItem> items;    ///< floes that changed, in the order of their sources
  PlaneReport plane;
  ImportTotals totals;
};

/// The floes of a text with their properties.
struct FloesOfText {
  std::vector<SourceFloe> floes;  ///< a floe is refused here if anything but its outline is wrong
  std::vector<NearMiss> near_misses;
  std::vector<std::string> notes;  ///< values that were converted when they were read, in words
  std::optional<double> run_time;  ///< time of the run that wrote the floes [s]; none: no run wrote them
};
FloesOfText floes_of(const FloeText& text, const PropertyRules& rules);

/// Projects floes to the plane, joins, repairs or refuses outlines that are not valid, simplifies them, and gives an
/// overlap of two floes to the larger one (geometry/cut/overlap.hpp). The properties stay in `floes`. Fails if the
/// floes have no place in the plane.
tl::expected<ImportOutcome, PlaneError> import_floes(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const ImportSettings& settings);

/// Ids of imported floes.
struct ImportedIds {
  std::vector<std::int64_t> ids;                  ///< id of each imported floe
  std::vector<std::optional<std::string>> other;  ///< id in the file as JSON, if it could not be kept
  std::string key;                                ///< name of the property that stores such ids
  std::string note;                               ///< why ids of the file were not kept, in words; empty: they were
};
/// Returns the ids of the file if every floe has a usable one, or else numbers. Further pieces of a floe get new
/// numbers.
ImportedIds ids_of(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                   const std::vector<FloeEntry>& entries);

/// Returns the imported floes as GeoJSON in metres with the properties of their features. `entries` are the entries of
/// the file, one for each of its floes.
std::string to_geojson(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                       const std::vector<FloeEntry>& entries, const ImportedIds& ids);

/// Returns the report of an import as JSON: totals, how the coordinates were projected, and each floe that changed
/// (docs/import.md).
std::string to_json_text(const ImportOutcome& imported, const std::string& file, const std::vector<FloeEntry>& entries,
                         const FloesOfText& read, const std::vector<std::string>& notes);

/// Returns "812 floes read, 3 repaired, 12 trimmed, 2 dropped, 1 refused; 809 written".
std::string counts_in_words(const ImportTotals& totals);

/// Returns "2 of 3 floes have a thickness of their own".
std::string thickness_in_words(std::size_t with_thickness, std::size_t floes);

/// Returns "123.4 m² read + 0.5 repaired − 3 trimmed − 1 dropped = 119.9 m² written".
std::string areas_in_words(const ImportTotals& totals);

/// Says how the coordinates were projected to the plane: "WGS 84, projected about 78.2, 15.6".
std::string plane_in_words(const PlaneReport& plane);

/// Says what happened to a floe: "self-crossing at (0, 0), repaired, +3 m²; trimmed, −2 m² to feature 3".
std::string item_in_words(const ImportItem& item, const std::vector<FloeEntry>& entries);

}  // namespace polynya::io
