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

/// Which pieces of a cut by a disc or a polygon stay. Cracks and lines keep everything.
enum class Keep { kOutside, kInside, kBoth };
std::string_view name_of(Keep keep);

/// The regular polygon inscribed in a circle that cuts in its place.
struct DiscTool {
  geometry::Point centre;
  double radius = 0;   ///< [m]
  double sagitta = 0;  ///< by which the polygon may stay inside the circle [m]
  geometry::Polygon polygon;
};
/// Polygons, all of them together; ready for geometry::cut_by_polygons.
struct PolygonTool {
  std::vector<geometry::Polygon> polygons;
};
/// The straight line through a point.
struct CrackTool {
  geometry::Point point;
  double angle_deg = 0;  ///< from the x axis, counter-clockwise
};
/// A path from its first point to its last.
struct LineTool {
  CutPath path;
  std::optional<double> snap = {};  ///< how far its ends may lie before what they meet [m]; none: default_snap()
};

/// One cut, of all pieces there are.
struct CutOp {
  std::variant<DiscTool, PolygonTool, CrackTool, LineTool> tool;
  Keep keep = Keep::kOutside;
  bool must_cut = false;  ///< refuses a floe of which it leaves a piece whole, else that is no fault
};

/// Defaults of all cuts.
struct CutDefaults {
  Keep keep = Keep::kOutside;
  double sagitta = 0;               ///< [m]; 0: default_sagitta() of the radius
  std::optional<double> snap = {};  ///< of lines [m]; none: default_snap()
};

/// Why there is no tool. A polygon that is not valid is another matter than a list that is not one.
struct ToolError {
  enum class Kind { kMalformed, kInvalidPolygon };
  Kind kind = Kind::kMalformed;
  std::string words;
};
template <class Value>
using ToolOutcome = tl::expected<Value, ToolError>;

/// 0.02 m, or 1/250 of the radius of discs smaller than 5 m: those have 36 vertices.
double default_sagitta(double radius);

/// So many finite numbers, between commas, as JSON has them.
Result<std::vector<double>> read_numbers(std::string_view text, std::size_t least, std::size_t most);

/// The cut of that kind by its numbers: "disc" x, y, radius, "crack" x, y, angle [°], "line" from x, y to x, y.
ToolOutcome<CutOp> op_of_numbers(std::string_view kind, const std::vector<double>& numbers, double sagitta);
ToolOutcome<LineTool> line_tool(std::vector<geometry::Point> path);
/// The polygons of a text in any of the formats of floes (floe_text.hpp).
ToolOutcome<PolygonTool> polygon_tool(std::string text);

/// A JSON list of cuts (docs/cut.md):
///   [{"disc": [x, y, r], "sagitta_m": s}, {"crack": [x, y, angle_deg]}, {"line": [x0, y0, x1, y1], "snap_m": s},
///    {"polygon": GeoJSON}], each with an optional "keep" and "must_cut".
ToolOutcome<std::vector<CutOp>> read_cut_ops(const std::string& text, const CutDefaults& defaults);

/// A polygon that was refused, or a floe that could not be cut.
struct Rejection {
  std::string reason;                     ///< "self-crossing"; see docs/cut.md
  std::string detail;                     ///< for people
  std::vector<geometry::Point> vertices;  ///< the offending ones [m]
};

struct RepairNote {
  std::string_view rule;
  std::string defect;       ///< what was wrong
  double area_drawn = 0;    ///< Σ signed areas of the rings as given [m²]
  double area_changed = 0;  ///< repaired − drawn [m²]
  std::size_t shapes = 0;   ///< how many polygons it became
};

struct CutPiece {
  std::int64_t floe_id = 0;
  geometry::Part part = geometry::Part::kOutside;
  double area = 0;  ///< [m²]
  geometry::Polygon polygon;
};

/// What became of one floe. area_of_pieces + removed = area + rounding_defect.
struct CutFloe {
  std::int64_t floe_id = 0;
  std::size_t feature = 0;
  std::size_t member = 0;
  std::size_t line = 0;
  double area = 0;            ///< of the floe, after repair if it was repaired [m²]
  double area_of_pieces = 0;  ///< [m²]
  double removed = 0;         ///< what was not kept, slivers included [m²]
  double area_slivers = 0;    ///< of that, what was too narrow to survive rounding [m²]
  int slivers = 0;
  int snap_rounded = 0;            ///< pieces of any cut whose nearest doubles were not valid
  double rounding_defect = 0;      ///< what rounding the vertices changed [m²]
  std::string exact_defect = "0";  ///< Σ exact pieces + removed − parent, over all cuts, as a rational
  std::vector<CutPiece> pieces;
  double dangling_length = 0;  ///< of what of lines ends inside ice, or only leads from hole to hole [m]
  std::optional<Rejection> rejected;
  std::optional<RepairNote> repair;
  std::shared_ptr<const std::string> properties;  ///< for its pieces, as in FloeEntry
  std::optional<std::string> source_id;           ///< what the text calls it, where floes are numbered: JSON
};

struct CutReport {
  std::vector<CutOp> ops;
  std::vector<CutFloe> floes;  ///< in the order of the text
  std::string crs;             ///< of the text, JSON, for the pieces; or empty
  StatedPlace place;           ///< likewise, of a text that Polynya wrote
  std::string ids_replaced;    ///< why floes are numbered though the text has ids (io/text/floe_ids.hpp); or empty
  std::string source_id_key;   ///< the property of a piece that then has what the text calls its floe
};

/// Cuts every floe by all cuts in order. A polygon that is not valid is refused, or repaired where a rule is
/// given; a floe that a cut does not meet stays whole; a floe that geometry fails to cut stays as it was
/// before that cut. Lines and cracks that follow each other cut together, so that their order does not matter.
CutReport cut_floes(const std::vector<FloeEntry>& entries, std::vector<CutOp> ops,
                    std::optional<geometry::FillRule> repair_rule);

std::string_view name_of(geometry::Part part);

struct CutTotals {
  double area = 0, area_of_pieces = 0, removed = 0, area_slivers = 0, rounding_defect = 0;  ///< [m²]
  std::string exact_defect = "0";
  std::size_t floes = 0, pieces = 0, slivers = 0, snap_rounded = 0, repaired = 0, rejected = 0;
  double dangling_length = 0;  ///< [m]
  double area_repaired = 0;    ///< Σ area_changed of repairs [m²]
};
CutTotals totals_of(const CutReport& report);

/// The ledger as JSON: {"tools": […], "floes": […], "totals": {…}} (docs/cut.md).
std::string to_ledger_json(const CutReport& report);

/// All pieces, in the order of their floes, with their parents' properties and the crs. GeoJSON is one
/// FeatureCollection, NDJSON a Feature a line, WKT a POLYGON a line (which can carry neither properties, the
/// ledger lists them in the same order, nor a crs).
std::string to_floe_text(const CutReport& report, FloeFormat format);

}  // namespace polynya::io
