#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::geometry {

/// What two placed floes have in common.
struct Overlap {
  double area = 0;         ///< nearest double [m²]
  std::string exact_area;  ///< as a rational: "0" where the interiors are disjoint
};

/// The area two placed shapes share, exactly: each vertex is placed by its pose's doubles in rational
/// arithmetic. A shape covers the points around which its rings wind more often counter-clockwise than
/// clockwise: those inside it where it is valid. Rings may cross themselves and each other. Fails where a
/// coordinate is not finite or beyond 1e70 m (kInvalidShape), and where CGAL refuses (kInternal).
tl::expected<Overlap, CutError> overlap(const Shape& a, const Pose& world_from_a, const Shape& b,
                                        const Pose& world_from_b);

/// The area of overlap() of two valid polygons [m²], found from the near part of the longer one and all of the other.
tl::expected<double, CutError> shared_area(const Polygon& a, const Pose& world_from_a, const Polygon& b,
                                           const Pose& world_from_b);

/// The ring with vertices left out such that it winds around every point of the box as before. A run of
/// vertices that all lie beyond one side of the box may be drawn straight without passing over it. Elsewhere
/// the result may cross itself. Few vertices are left of a long ring beside a small box.
Ring near_part(const Ring& ring, const Box& box);

/// Overlaps thinner than this are taken for the rounding of shared edges [m]. Below some 1e-12 (of
/// coordinates of kilometres) floes that share an edge overlap.
inline constexpr double kTouchingDepth = 1e-9;
/// Exactly found overlaps of less area than this likewise [m²]: a shared edge of a kilometre times kTouchingDepth.
inline constexpr double kTouchingArea = 1e-6;

struct OverlappingPair {
  std::size_t first = 0;  ///< the lower index
  std::size_t second = 0;
  double area = 0;  ///< [m²]
};

/// Which of the polygons share area, in the order of their indices; shared edges and corners are no overlap.
/// All must be valid. A tree of boxes finds the pairs (near linear for fields of ice), a separating edge
/// decides most, an exact cut the rest. Stops at `most`.
std::vector<OverlappingPair> find_overlapping_pairs(const std::vector<Polygon>& polygons, std::size_t most);

/// What is left of a polygon where larger ones overlap it.
struct Trimmed {
  std::vector<Polygon> pieces;      ///< valid; the polygon itself where nothing overlaps it, none if all is
  std::vector<std::size_t> yields;  ///< to which of the polygons, ascending
  double area_trimmed = 0;          ///< Σ exact areas taken off, slivers among them [m²]
  double rounding_defect = 0;       ///< Σ of the cuts': pieces as returned − exact pieces [m²]
  std::optional<CutError> error;    ///< of a cut that geometry refused; the pieces are then empty
};

/// Makes polygons disjoint: where two share area it stays with the larger one, of equal ones with the first.
/// With a gap, all that lies nearer to the larger one than that is cut off too, up to 4 % farther at its
/// corners [m]. Shared areas of at most kTouchingArea are the rounding of shared
/// edges and stay. All polygons must be valid. Each is cut exactly, by one of the others after the other;
std::vector<Trimmed> make_disjoint(const std::vector<Polygon>& polygons, double gap);

/// Where and when two outlines that move in straight lines without turning first meet.
struct FirstContact {
  double time = 0;  ///< from now on [s]
  Point point;      ///< where that point of a is now [m]
  Vector normal;    ///< unit, from a into b
};

/// The first contact of `a` and `b` at a time in [from, until] [s], b moving at `velocity` relative to a
/// [m/s]; both are counter-clockwise and in one frame. A time before 0 lies in the past. Outlines that only
/// slide along each other have none.
std::optional<FirstContact> first_contact(const Ring& a, const Ring& b, Vector velocity, double from, double until);

}  // namespace polynya::geometry
