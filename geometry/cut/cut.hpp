#pragma once

#include <string>
#include <string_view>
#include <vector>

#include <tl/expected.hpp>

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// Where a piece lies with respect to the cutting polygon; pieces of a crack are `kOutside`.
enum class Part { kOutside, kInside };

struct Piece {
  Shape shape;  ///< in the parent's body frame
  Part part = Part::kOutside;
};

/// What one cut did to the area, to the last bit. Signs: a defect is (after − before).
struct CutLedger {
  double area_before = 0;      ///< [m²]
  double area_outside = 0;     ///< Σ areas of the outside pieces as returned [m²]
  double area_inside = 0;      ///< Σ areas of the inside pieces as returned [m²]
  double area_slivers = 0;     ///< what was too narrow to survive rounding and is in no piece [m²]
  int slivers = 0;             ///< how many such
  double rounding_defect = 0;  ///< (pieces as returned + slivers) − (exact pieces), nearest double [m²]
  std::string exact_defect;    ///< Σ exact pieces − parent as a rational [m²]: "0", or the cut is refused
  double dangling_length = 0;  ///< of crack that runs in the ice and separates nothing [m]
  int snap_rounded = 0;        ///< exact pieces whose nearest doubles were not valid, rounded another way
};

struct CutResult {
  std::vector<Piece> pieces;  ///< ordered by (part, lowest vertex); empty parts are absent
  CutLedger ledger;
};

/// In the order of name_of().
enum class CutFailure {
  kInvalidShape,     ///< the shape itself is not a valid polygon
  kInvalidTool,      ///< the disc, polygon or polyline is not usable
  kMisses,           ///< the tool does not meet the shape's interior: nothing to cut
  kDoesNotSeparate,  ///< the crack ends inside the ice: it separates nothing
  kInternal,         ///< a check after the cut failed; the shape is left as it was
};
std::string_view name_of(CutFailure reason);

struct CutError {
  CutFailure reason;
  std::string detail;          ///< for people
  double dangling_length = 0;  ///< where a crack does not separate: how much of it runs in the ice [m]
};
std::string to_string(const CutError& error);  ///< "reason: detail"

using CutOutcome = tl::expected<CutResult, CutError>;

/// Cuts a shape by a polygon (a cusp's disc, usually) given in the shape's body frame.
/// A transaction: pieces outside and inside whose exact areas sum to the shape's, or an error and no change.
CutOutcome cut_by_polygon(const Shape& shape, const Polygon& tool_in_body);

/// The same with a tool of several polygons with holes, which may touch or overlap: what any of them covers is inside.
CutOutcome cut_by_polygons(const Shape& shape, const std::vector<Polygon>& tools_in_body);

/// Cuts a shape along an open polyline in its body frame (a crack). The polyline separates where it crosses
/// the shape fully; what dangles inside the ice does not separate and is ignored.
CutOutcome cut_along(const Shape& shape, const std::vector<Point>& polyline_in_body);

/// The same along several polylines together. They may cross, touch and end on each other: what they enclose between
/// them is a piece, whatever their order.
CutOutcome cut_along_all(const Shape& shape, const std::vector<std::vector<Point>>& polylines_in_body);

/// A regular polygon inscribed in a circle, with as many vertices as keep its sagitta within `sagitta` [m].
/// Counter-clockwise, from a vertex along `axis`, a unit vector, to both sides of which it is the same. Throws nothing;
/// radius and sagitta must be > 0.
Ring disc_polygon(Point centre, double radius, double sagitta, Vector axis = {1, 0});

// ---- repair

/// Which points rings that cross themselves and each other enclose.
enum class FillRule {
  kEvenOdd,  ///< those from which a ray crosses the rings an odd number of times
  kNonZero,  ///< those the rings wind around
};

struct Repaired {
  std::vector<Shape> shapes;  ///< valid, disjoint; ordered by lowest vertex
  double area_drawn = 0;      ///< Σ signed areas of the rings as given, as a magnitude [m²]
  double area = 0;            ///< of all shapes [m²]
  double area_changed = 0;    ///< repaired − drawn, from exact areas [m²]
  CutLedger ledger;           ///< of rounding the crossings; its `area_before` is the exact repaired area
};

/// Makes valid polygons of rings that are not, exactly, on request only: nothing else in this room repairs.
/// Repeated points are dropped and enclose nothing; rings of fewer than three points too. Fails where a
/// coordinate is not finite (kInvalidShape) or where nothing is enclosed (kMisses).
tl::expected<Repaired, CutError> repair(const std::vector<Ring>& rings, FillRule rule);

/// The union of valid polygons, which may touch and overlap, exact but for one rounding of its vertices.
tl::expected<std::vector<Polygon>, CutError> union_of(const std::vector<Polygon>& polygons);

/// All rings of a polygon, the outer one first.
std::vector<Ring> rings_of(const Polygon& polygon);

/// The ring without points equal to the one before, a closing point included.
Ring without_repeats(const Ring& ring);

/// The polygon without repeated points, its outer ring counter-clockwise and its holes clockwise, as
/// find_defect and the cuts expect. Nothing else changes.
Polygon normalised(const Polygon& polygon);

}  // namespace polynya::geometry
