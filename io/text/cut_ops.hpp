#pragma once

#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "geometry/shape/polygon.hpp"
#include "io/text/result.hpp"

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
  std::vector<geometry::Point> path;
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
  double sagitta = 0;  ///< [m]; 0: default_sagitta() of the radius
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

/// Exactly `count` finite numbers, between commas; nothing else beside blanks.
Result<std::vector<double>> read_numbers(std::string_view text, std::size_t count);

/// The cut of that kind by its numbers: "disc" x, y, radius, "crack" x, y, angle [°], "line" from x, y to x, y.
ToolOutcome<CutOp> op_of_numbers(std::string_view kind, const std::vector<double>& numbers, double sagitta);
ToolOutcome<LineTool> line_tool(std::vector<geometry::Point> path);
/// The polygons of a text in any of the formats of floes (floe_text.hpp).
ToolOutcome<PolygonTool> polygon_tool(std::string text);

/// A JSON list of cuts (docs/cut.md):
///   [{"disc": [x, y, r], "sagitta_m": s}, {"crack": [x, y, angle_deg]}, {"line": [x0, y0, x1, y1]},
///    {"polygon": GeoJSON}], each with an optional "keep" and "must_cut".
ToolOutcome<std::vector<CutOp>> read_cut_ops(const std::string& text, const CutDefaults& defaults);

}  // namespace polynya::io
