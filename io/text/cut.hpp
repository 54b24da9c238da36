#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/polygon.hpp"
#include "io/text/cut_lines.hpp"
#include "io/text/floe_text.hpp"
#include "io/text/source_text.hpp"

namespace polynya::io {

/// Selection of the pieces that a cut by a disc or a polygon keeps. A cut by a crack or a line keeps all pieces.
enum class Keep { kOutside, kInside, kBoth };
/// Returns the word for it in lists of cuts: "outside", "inside" or "both".
std::string_view name_of(Keep keep);

// The tools of cuts. Points are in the coordinates of the floes [m].

/// A circle. The floe is cut by a regular polygon that is inscribed in it.
struct DiscTool {
  geometry::Point centre;
  double radius = 0;  ///< [m]
  /// Largest distance between the circle and the sides of the polygon [m]. A smaller one gives more vertices.
  double sagitta = 0;
  geometry::Polygon polygon;  ///< the polygon that cuts
};
/// Several polygons that cut as their union, prepared for geometry::cut_by_polygons. They may overlap.
struct PolygonTool {
  std::vector<geometry::Polygon> polygons;
};
/// A straight crack through a point, across the whole floe.
struct CrackTool {
  geometry::Point point;
  double angle_deg = 0;  ///< direction from the x axis, counter-clockwise [°]
};
/// A path from its first point to its last one, along which the floe is cut.
struct LineTool {
  CutPath path;
  /// An end is extended to the ice boundary or another path within this distance [m]; none: default_snap()
  std::optional<double> snap = {};
};

/// One cut. It is applied to all pieces that exist when its turn comes.
struct CutOp {
  std::variant<DiscTool, PolygonTool, CrackTool, LineTool> tool;
  Keep keep = Keep::kOutside;
  /// True: if this cut leaves a piece of a floe whole, the floe is reported as rejected, and the piece stays. False:
  /// that is no error.
  bool must_cut = false;
};

/// Values for cuts that do not state their own. `must_cut` has none: it is false unless the cut states it.
struct CutDefaults {
  Keep keep = Keep::kOutside;
  double sagitta = 0;  ///< largest distance between a circle and its polygon [m]; 0: default_sagitta() of the radius
  std::optional<double> snap = {};  ///< distance within which ends of lines are extended [m]; none: default_snap()
};

/// Reason why there is no tool. The kind distinguishes a mistake in the list of cuts from a polygon with an invalid
/// outline; `polynya cut` has another exit code for each.
struct ToolError {
  enum class Kind { kMalformed, kInvalidPolygon };
  Kind kind = Kind::kMalformed;
  std::string words;
};
template <class Value>
using ToolOutcome = tl::expected<Value, ToolError>;

/// Returns the default distance between a circle and the polygon that cuts [m], for a radius [m]: 0.02 m, or 1/250 of
/// the radius of discs smaller than 5 m, which gives 36 vertices. Larger discs have more.
double default_sagitta(double radius);

/// Reads `least` to `most` finite numbers in JSON notation with commas between them, as options have them. Fails if the
/// text is no such list, or has another number of items.
Result<std::vector<double>> read_numbers(std::string_view text, std::size_t least, std::size_t most);

/// Returns the cut of a kind from its numbers, as many as the kind needs: "disc" from x, y, radius [m]; "crack" from x,
/// y [m] and angle [°]; "line" from x, y of one point and x, y of the other [m]. The caller must check the kind and the
/// number of numbers: an unknown kind is taken for "crack". `sagitta` [m] is for discs; 0: default_sagitta(). Fails if
/// the radius is not above 0, if the circle is too small for the precision of its coordinates, or if the ends of the
/// line are one point.
ToolOutcome<CutOp> op_of_numbers(std::string_view kind, const std::vector<double>& numbers, double sagitta);
/// Returns the cut along a path without points that repeat the point before. Fails if fewer than two points remain.
ToolOutcome<LineTool> line_tool(std::vector<geometry::Point> path);
/// Reads the polygons of a text in any of the formats of floe_text.hpp. Fails if there is none, or if one is not valid.
ToolOutcome<PolygonTool> polygon_tool(std::string text);

/// Reads a JSON list of cuts (docs/cut.md):
///   [{"disc": [x, y, r], "sagitta_m": s}, {"crack": [x, y, angle_deg]}, {"line": [x0, y0, x1, y1], "snap_m": s},
///    {"polygon": GeoJSON}], each with an optional "keep" and "must_cut".
/// The error begins with the number of the cut in the list, from 0: "[2]: disc: the radius is not > 0". A list without
/// cuts is an error too.
ToolOutcome<std::vector<CutOp>> read_cut_ops(const std::string& text, const CutDefaults& defaults);

/// Reason why a polygon was refused, or why a floe could not be cut.
struct Rejection {
  std::string reason;                     ///< short name, such as "self-crossing"; docs/cut.md lists them
  std::string detail;                     ///< explanation for the message
  std::vector<geometry::Point> vertices;  ///< positions of the fault [m]
};

/// Record of the repair of an outline that was not valid.
struct RepairNote {
  std::string_view rule;    ///< the fill rule: "even-odd" or "non-zero"
  std::string defect;       ///< the fault that was repaired
  double area_drawn = 0;    ///< magnitude of the sum of the signed areas of the rings as given [m²]
  double area_changed = 0;  ///< repaired − drawn [m²]
  std::size_t shapes = 0;   ///< number of polygons after the repair
};

/// One piece of a floe after all cuts.
struct CutPiece {
  std::int64_t floe_id = 0;  ///< new id, larger than those of all floes of the text, also if the floe stayed whole
  /// Side of the last disc or polygon on which the piece lies; outside if there was none.
  geometry::Part part = geometry::Part::kOutside;
  double area = 0;  ///< [m²]
  geometry::Polygon polygon;
};

/// Result of all cuts for one floe. area_of_pieces + removed = area + rounding_defect.
struct CutFloe {
  std::int64_t floe_id = 0;  ///< id in the text, or the floe's number in the text, from 0, if floes are numbered
  std::size_t feature = 0;   ///< this and the next two say where the floe is in the text, as in FloeEntry
  std::size_t member = 0;
  std::size_t line = 0;
  double area = 0;            ///< area of the floe, after its repair if it was repaired [m²]
  double area_of_pieces = 0;  ///< [m²]
  double removed = 0;         ///< area that was not kept, including slivers [m²]
  double area_slivers = 0;    ///< part of `removed` that was too narrow to survive the rounding of its vertices [m²]
  int slivers = 0;            ///< number of such parts; cuts of every kind drop them
  /// Number of pieces whose vertices, rounded to the nearest doubles, did not make a valid polygon. They were made
  /// valid by rounding in another way.
  int snap_rounded = 0;
  double rounding_defect = 0;  ///< area that the rounding of vertices changed [m²]
  /// Σ exact areas of the pieces of a cut, before any is removed or rounded, − area of the piece that was cut [m²], as
  /// a rational number, of the last cut for which it is not 0; "0" unless there is a bug.
  std::string exact_defect = "0";
  std::vector<CutPiece> pieces;
  /// Length of lines that separate nothing: they end inside the ice, or lead from hole to hole [m].
  double dangling_length = 0;
  /// Reason why its outline was refused, and it has no pieces; or why the last cut that failed did, and it has pieces.
  std::optional<Rejection> rejected;
  std::optional<RepairNote> repair;               ///< only if its outline was repaired
  std::shared_ptr<const std::string> properties;  ///< properties that the pieces inherit, as in FloeEntry
  std::optional<std::string> source_id;           ///< id in the text as JSON, if floes are numbered instead
};

/// Result of cutting all floes of a text.
struct CutReport {
  std::vector<CutOp> ops;      ///< the cuts, in order
  std::vector<CutFloe> floes;  ///< in the order of the text
  std::string crs;             ///< coordinate system of the text as JSON, which the pieces keep; may be empty
  StatedPlace place;           ///< place on the Earth that the text states, if Polynya wrote it
  /// Reason why floes are numbered although the text has ids (io/text/floe_ids.hpp); empty: ids are kept, or the text
  /// has none.
  std::string ids_replaced;
  std::string source_id_key;  ///< name of the property in which a piece then keeps the id of the text
};

/// Cuts every floe by all cuts in order, and returns the report, except for its `crs` and `place`. A polygon that is
/// not valid is refused, or repaired if a rule is given. A piece that a cut does not meet stays whole. It counts as
/// outside of a disc or polygon, so that Keep::kInside removes it. A piece that geometry fails to cut stays as it was
/// before that cut, and the floe is reported as rejected. Consecutive lines and cracks without must_cut cut a floe
/// together if one of them ends within the floe's bounding box, so that their order does not matter. The largest snap
/// that one of them states then holds for all. If none ends there, they cut one after the other, as other cuts do.
CutReport cut_floes(const std::vector<FloeEntry>& entries, std::vector<CutOp> ops,
                    std::optional<geometry::FillRule> repair_rule);

/// Returns "inside" or "outside".
std::string_view name_of(geometry::Part part);

/// Sums over all floes of a report.
struct CutTotals {
  double area = 0, area_of_pieces = 0, removed = 0, area_slivers = 0, rounding_defect = 0;  ///< [m²]
  std::string exact_defect = "0";  ///< no sum: that of the last floe that has one; "0" unless there is a bug
  std::size_t floes = 0, pieces = 0, slivers = 0, snap_rounded = 0, repaired = 0, rejected = 0;
  double dangling_length = 0;  ///< [m]
  double area_repaired = 0;    ///< Σ area_changed of repairs [m²]
};
CutTotals totals_of(const CutReport& report);

/// Returns the report as JSON: {"tools": […], "floes": […], "totals": {…}} (docs/cut.md).
std::string to_ledger_json(const CutReport& report);

/// Returns all pieces in the order of their floes, with the properties of their floes and the coordinate system.
/// GeoJSON is one FeatureCollection, NDJSON one Feature per line, WKT one POLYGON per line. WKT can hold neither
/// properties nor a coordinate system; the JSON report lists the pieces in the same order.
std::string to_floe_text(const CutReport& report, FloeFormat format);

}  // namespace polynya::io
