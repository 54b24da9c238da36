#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// The place of a piece relative to the cutting polygon; pieces of a crack are `kOutside`.
enum class Part { kOutside, kInside };

struct Piece {
  Shape shape;  ///< in the parent's body frame
  Part part = Part::kOutside;
};

/// Account of the areas of one cut, exact to the last bit. Sign of a defect: after − before.
struct CutLedger {
  double area_before = 0;      ///< [m²]
  double area_outside = 0;     ///< Σ areas of the outside pieces as returned [m²]
  double area_inside = 0;      ///< Σ areas of the inside pieces as returned [m²]
  double area_slivers = 0;     ///< area that was too narrow to survive rounding and is in no piece [m²]
  int slivers = 0;             ///< number of such slivers
  double rounding_defect = 0;  ///< (pieces as returned + slivers) − (exact pieces), nearest double [m²]
  std::string exact_defect;    ///< Σ exact pieces − parent as a rational [m²]: "0", or the cut is refused
  double dangling_length = 0;  ///< length of crack that runs in the ice and separates nothing [m]
  int snap_rounded =
      0;  ///< number of exact pieces whose nearest doubles were invalid, so that they were rounded in another way
};

struct CutResult {
  std::vector<Piece> pieces;  ///< ordered by (part, lowest vertex); empty parts are absent
  CutLedger ledger;
};

/// The reasons why a cut is refused, in the order of name_of().
enum class CutFailure {
  kInvalidShape,     ///< the shape itself is not a valid polygon
  kInvalidTool,      ///< the disc, polygon or polyline is not usable
  kMisses,           ///< the tool does not touch the shape's interior, so there is nothing to cut
  kDoesNotSeparate,  ///< the crack ends inside the ice, so it separates nothing
  kInternal,         ///< a check after the cut failed; the shape is unchanged
};
std::string_view name_of(CutFailure reason);

struct CutError {
  CutFailure reason;
  std::string detail;          ///< explanation for people
  double dangling_length = 0;  ///< length of crack in the ice, if it does not separate [m]
};
std::string to_string(const CutError& error);  ///< "reason: detail"

using CutOutcome = tl::expected<CutResult, CutError>;

/// Cuts a shape by a polygon (usually a cusp's disc) that is given in the shape's body frame. The cut is a transaction:
/// it returns pieces outside and inside whose exact areas add up to the shape's, or an error without any change.
CutOutcome cut_by_polygon(const Shape& shape, const Polygon& tool_in_body);

/// The same with several polygons with holes as the tool. They may touch or overlap; a point in any of them is inside.
CutOutcome cut_by_polygons(const Shape& shape, const std::vector<Polygon>& tools_in_body);

/// Cuts a shape along an open polyline in its body frame (a crack). The polyline separates where it crosses the shape
/// completely; parts that end inside the ice do not separate and are ignored.
CutOutcome cut_along(const Shape& shape, const std::vector<Point>& polyline_in_body);

/// The same along several polylines together. They may cross, touch and end on each other. An area that they enclose
/// together is a piece, whatever their order.
CutOutcome cut_along_all(const Shape& shape, const std::vector<std::vector<Point>>& polylines_in_body);

/// Returns a regular polygon inscribed in a circle, with as many vertices as are needed to keep its sagitta within
/// `sagitta` [m]. It runs counter-clockwise from a vertex along `axis`, a unit vector about which it is symmetric. Does
/// not throw; radius and sagitta must be > 0.
Ring disc_polygon(Point centre, double radius, double sagitta, Vector axis = {1, 0});

// ---- repair

/// The rules for which points are enclosed by rings that cross themselves and each other.
enum class FillRule {
  kEvenOdd,  ///< points from which a ray crosses the rings an odd number of times
  kNonZero,  ///< points around which the rings wind
};

struct Repaired {
  std::vector<Shape> shapes;  ///< valid, disjoint; ordered by lowest vertex
  double area_drawn = 0;      ///< magnitude of Σ signed areas of the rings as given [m²]
  double area = 0;            ///< total area of the shapes [m²]
  double area_changed = 0;    ///< repaired − drawn, from exact areas [m²]
  CutLedger ledger;           ///< of rounding the crossings; its `area_before` is the exact repaired area
};

/// Makes valid polygons from invalid rings, exactly. Only on request: no other function of geometry repairs. Repeated
/// points, and rings of fewer than three points, enclose nothing and are dropped. Fails if a coordinate is not finite
/// (kInvalidShape) or nothing is enclosed (kMisses).
tl::expected<Repaired, CutError> repair(const std::vector<Ring>& rings, FillRule rule);

/// Returns the union of valid polygons, which may touch and overlap, exact except for one rounding of its vertices.
tl::expected<std::vector<Polygon>, CutError> union_of(const std::vector<Polygon>& polygons);

/// Returns all rings of a polygon, the outer one first.
std::vector<Ring> rings_of(const Polygon& polygon);

/// Returns the ring without points equal to the one before; a closing point is dropped too.
Ring without_repeats(const Ring& ring);

/// Returns the polygon without repeated points, with its outer ring counter-clockwise and its holes clockwise, as
/// find_defect and the cuts require. Nothing else changes.
Polygon normalised(const Polygon& polygon);

}  // namespace polynya::geometry
