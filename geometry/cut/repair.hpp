#pragma once

#include <vector>

#include "geometry/cut/cut.hpp"

namespace polynya::geometry {

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
