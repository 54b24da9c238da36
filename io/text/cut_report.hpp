#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "io/text/cut_ops.hpp"
#include "io/text/floe_text.hpp"

namespace polynya::io {

/// A part of a line that ends inside ice, or only leads from hole to hole, and separates nothing.
struct Dangling {
  geometry::Point from;
  geometry::Point to;
};

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
  double dangling_length = 0;      ///< of lines that run in the ice and separate nothing [m]
  std::vector<Dangling> dangling;  ///< where
  std::optional<Rejection> rejected;
  std::optional<RepairNote> repair;
  std::shared_ptr<const std::string> properties;  ///< for its pieces, as in FloeEntry
};

struct CutReport {
  std::vector<CutOp> ops;
  std::vector<CutFloe> floes;  ///< in the order of the text
  std::string crs;             ///< of the text, JSON, for the pieces; or empty
};

std::string_view name_of(geometry::Part part);

struct CutTotals {
  double area = 0, area_of_pieces = 0, removed = 0, area_slivers = 0, rounding_defect = 0;  ///< [m²]
  std::string exact_defect = "0";
  std::size_t floes = 0, pieces = 0, slivers = 0, snap_rounded = 0, dangling = 0, repaired = 0, rejected = 0;
  double area_repaired = 0;  ///< Σ area_changed of repairs [m²]
};
CutTotals totals_of(const CutReport& report);

/// The ledger as JSON: {"tools": […], "floes": […], "totals": {…}} (docs/cut.md).
std::string to_ledger_json(const CutReport& report);

/// All pieces, in the order of their floes, with their parents' properties and the crs. GeoJSON is one
/// FeatureCollection, NDJSON a Feature a line, WKT a POLYGON a line (which can carry neither properties, the
/// ledger lists them in the same order, nor a crs).
std::string to_floe_text(const CutReport& report, FloeFormat format);

}  // namespace polynya::io
