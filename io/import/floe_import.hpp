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

/// Settings of an import: which changes it makes to the floes of a file. They are made in this order: plane, join,
/// repair, simplify, gap, least area (docs/import.md). Each is an option of `polynya import` and a key of an entry's
/// "import" in a scene.
struct ImportSettings {
  PlaneSettings plane;  ///< plane to which the coordinates of the file are brought
  /// Polygons of one feature, and polygons on both sides of longitude 180 with equal properties, are joined if their
  /// boundaries are within this distance of each other [m]. Slits narrower than this are closed, and corners move by up
  /// to this distance. With 0 nothing is joined.
  double join = 0;
  /// Rule which decides what an outline that crosses itself encloses, so that it is replaced by valid polygons; none:
  /// floes with invalid outlines are refused.
  std::optional<geometry::FillRule> repair;
  /// Vertices are left out if they lie within this distance of the remaining outline [m]. A larger value leaves out
  /// more vertices, so that runs take less time. With 0 all vertices are kept. A floe whose outline would become
  /// invalid keeps all of its vertices.
  double simplify = 0;
  /// Pieces with less area than this are dropped [m²]. Pieces that cannot be a rigid body (simulation::can_be_floe) are
  /// dropped even with 0. It is compared after overlaps were cut off.
  double least_area = 0;
  /// Least distance between two floes [m]. The smaller of the two, by area, is cut back to it. With 0 only overlaps are
  /// cut off. With a larger value floes do not touch at the start of a run.
  double gap = 0;
};

/// A floe in the plane, as an import writes it. One floe of the file may become several of these, or none.
struct ImportedFloe {
  /// Valid, in house notation: outer ring counter-clockwise, holes clockwise, no point twice (geometry::normalised)
  /// [m].
  geometry::Polygon polygon;
  std::size_t source = 0;  ///< index of the floe of the file from which it was made; of joined floes the first one
};

/// Changes that an import made to one floe of the file. Only floes that were changed or refused have one. Floes of the
/// file are named by their index in it. All areas are in m²; an added area is negative if area was lost.
struct ImportItem {
  std::size_t source = 0;  ///< index of the floe
  std::string refused;     ///< reason why it, or a piece of it, was refused and is not written; empty: it was not
  bool is_outline_refused = false;       ///< true if it was refused for its outline, which a repair may make valid
  std::vector<std::size_t> joined;       ///< other floes that were joined to this one, which is the first of them
  std::optional<std::size_t> joined_to;  ///< floe to which this one was joined; this one then becomes no floe itself
  bool is_closed = false;                ///< true if a slit in it was closed without joining it to another floe
  double joined_area = 0;                ///< area that joining, or closing a slit, added
  std::string defect;                    ///< fault of its outline, which was repaired; empty: it had none
  double repaired = 0;                   ///< area that the repair added
  /// Numbers of vertices before and after simplifying, of the pieces that were simplified; equal: none was left out.
  std::size_t vertices_before = 0, vertices_after = 0;
  double simplified = 0;  ///< area that leaving out vertices added
  double trimmed = 0;     ///< area that was cut off, for larger floes and for the gap; positive if it lost area
  std::vector<std::size_t> yields;  ///< larger floes for which area of this one was cut off
  double dropped = 0;               ///< area of its dropped pieces (ImportSettings::least_area)
  std::size_t dropped_pieces = 0;   ///< number of its dropped pieces
  double area_before = 0;           ///< area as read, in the plane; 0 if it was refused before overlaps were cut off
  double area_after = 0;            ///< area of the floes that it became
  std::size_t pieces = 0;           ///< number of floes that it became
};

/// Counts of floes and sums of areas over an import. Unless stated otherwise the counts are of floes of the file. Each
/// sum of areas [m²] is computed exactly and rounded once, except `area_repaired`, which adds up rounded areas.
struct ImportTotals {
  /// Numbers of floes that were read in all; that became part of another one by joining; that were refused because
  /// something is wrong with them; whose outline was made valid; that lost vertices; of which area was cut off for
  /// larger floes or the gap; and of which no piece is left because all were too small or cut off. `written` is the
  /// number of floes in the result: a floe of the file that was cut apart counts several times.
  std::size_t read = 0, joined = 0, refused = 0, repaired = 0, simplified = 0, trimmed = 0, dropped = 0, written = 0;
  std::size_t with_thickness = 0;  ///< floes among those written that have their own thickness
  double area_read = 0;            ///< area in the plane, as drawn, of all floes that were read and not refused then
  /// Areas that joining (and closing of slits), repairs and simplifying added; areas that were cut off for larger floes
  /// and gaps, and that dropped pieces had, both positive.
  double area_joined = 0, area_repaired = 0, area_simplified = 0, area_trimmed = 0, area_dropped = 0;
  double area_written = 0;  ///< area of the floes in the result
  double area_change = 0;   ///< written − read
};

/// Result of an import. It may have no floes.
struct ImportOutcome {
  std::vector<ImportedFloe> floes;  ///< floes to be written, in the order of their sources
  std::vector<ImportItem> items;    ///< floes that were changed or refused, in the order of their sources
  PlaneReport plane;                ///< how the coordinates were brought to the plane
  ImportTotals totals;
};

/// The floes of a text with their properties, before they are projected to the plane.
struct FloesOfText {
  /// One for each entry of the text. It is refused already if the entry has no polygon, or if a property has a value
  /// that no floe can have. Whether outlines are valid is checked by import_floes().
  std::vector<SourceFloe> floes;
  std::vector<NearMiss> near_misses;  ///< properties that are not read although their names are nearly right
  std::vector<std::string> notes;     ///< values that were converted or left out when they were read, in words
  /// Time of the run that wrote the floes [s]. A text is taken for the output of a run if it states a time and each of
  /// its floes has an id and "born_s". None: no run wrote them. A scene assumes that floes of a run may overlap where
  /// ice was crushed (FloeGroup::has_crushed_overlaps).
  std::optional<double> run_time;
};
/// Reads the properties of the entries of a text. `rules` state the names of the properties in the file, their units
/// and the numbers that mean "no value".
FloesOfText floes_of(const FloeText& text, const PropertyRules& rules);

/// Imports floes: projects them to the plane, joins parts, repairs or refuses outlines that are not valid, simplifies
/// outlines, cuts overlaps off the smaller floe of two (geometry/cut/overlap.hpp), and drops small pieces. `floes` are
/// changed to coordinates and velocities of the plane, and the refused ones are marked; the result refers to them by
/// index for their properties. `place` is the coordinate system that the file states. Fails if the floes as a whole
/// have no place in the plane (bring_to_plane). A floe that cannot be imported is no failure: it is refused, and the
/// others are imported.
tl::expected<ImportOutcome, PlaneError> import_floes(std::vector<SourceFloe>& floes, const FilePlace& place,
                                                     const ImportSettings& settings);

/// Ids of imported floes.
struct ImportedIds {
  std::vector<std::int64_t> ids;  ///< property "floe_id" of each imported floe; all differ
  /// For each imported floe the id of its source in the file, as JSON, if its `ids` differs from that; none otherwise.
  std::vector<std::optional<std::string>> other;
  std::string key;   ///< name of the property that stores `other`: "source_id", with _ appended if the file has it
  std::string note;  ///< why ids of the file were not kept, in words; empty: they were, or the file has none
};
/// Returns ids for imported floes. If each source that is left has a whole number as its id, and these differ, the ids
/// of the file are kept; otherwise floes are numbered from 0 in their order. The first piece of each source gets such
/// an id, and further pieces get larger numbers than all others.
ImportedIds ids_of(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                   const std::vector<FloeEntry>& entries);

/// Returns the imported floes as a GeoJSON FeatureCollection in metres of the plane, one feature per line, with members
/// that state the place of the plane on the Earth. A feature has Polynya's properties of its floe, and all other
/// properties of its source unchanged. `floes` are the ones that import_floes() was given; `entries` are the entries of
/// the file, one for each of its floes, and `ids` is what ids_of() returns for them. Refused and dropped floes are not
/// in it.
std::string to_geojson(const ImportOutcome& imported, const std::vector<SourceFloe>& floes,
                       const std::vector<FloeEntry>& entries, const ImportedIds& ids);

/// Returns the report of an import as JSON (docs/import.md): totals, how the coordinates were projected, and each floe
/// that was changed or refused. `file` is the name of the file, `read` has the near misses, and `notes` are all notes
/// of the import, also the ones in `read`. Areas that were cut off or dropped are negative in it, unlike those of
/// ImportItem and ImportTotals.
std::string to_json_text(const ImportOutcome& imported, const std::string& file, const std::vector<FloeEntry>& entries,
                         const FloesOfText& read, const std::vector<std::string>& notes);

/// Returns the counts in words; a count of 0 is left out: "812 floes read, 3 repaired, 12 trimmed, 2 dropped, 1
/// refused; 809 written".
std::string counts_in_words(const ImportTotals& totals);

/// Says how many floes have their own thickness: "2 of 3 floes have a thickness of their own". The others get that of
/// the scene.
std::string thickness_in_words(std::size_t with_thickness, std::size_t floes);

/// Returns the balance of areas in words; a term of 0 is left out: "123.4 m2 read + 0.5 repaired - 3 trimmed - 1
/// dropped = 119.9 m2 written".
std::string areas_in_words(const ImportTotals& totals);

/// Says how the coordinates were projected to the plane: "WGS 84, projected about 78.2, 15.6" (latitude, longitude
/// [°]).
std::string plane_in_words(const PlaneReport& plane);

/// Says what happened to a floe: "self-crossing at (0, 0), repaired, +3 m2; trimmed, 2 m2 to feature 3". Simplifying is
/// not mentioned, so the text is empty for a floe that was only simplified. `entries` gives the numbers of features.
std::string item_in_words(const ImportItem& item, const std::vector<FloeEntry>& entries);

}  // namespace polynya::io
