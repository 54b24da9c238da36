#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "geometry/cut/cut.hpp"
#include "geometry/shape/polygon.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::geometry {

/// The area that two placed floes share.
struct Overlap {
  double area = 0;         ///< nearest double [m²]
  std::string exact_area;  ///< as a rational: "0" if the interiors are disjoint
};

/// Returns the exact area that two placed shapes share: each vertex is placed by its pose's doubles in rational
/// arithmetic. A shape covers the points around which its rings wind more often counter-clockwise than clockwise; for a
/// valid shape these are the points inside it. Rings may cross themselves and each other. Fails if a coordinate is not
/// finite or beyond 1e70 m (kInvalidShape), and if CGAL refuses (kInternal).
tl::expected<Overlap, CutError> overlap(const Shape& a, const Pose& world_from_a, const Shape& b,
                                        const Pose& world_from_b);

/// Returns the area of overlap() for two valid polygons [m²], from the near part of the longer one and all of the
/// other.
tl::expected<double, CutError> shared_area(const Polygon& a, const Pose& world_from_a, const Polygon& b,
                                           const Pose& world_from_b);

/// Returns the ring with vertices left out such that it winds around every point of the box as before. A run of
/// vertices that all lie beyond one side of the box may be replaced by a straight line that does not pass over the box.
/// Elsewhere the result may cross itself. A long ring beside a small box keeps few vertices.
Ring near_part(const Ring& ring, const Box& box);

/// Thickness below which an overlap counts as the rounding of a shared edge [m]. Below about 1e-12 (for coordinates of
/// kilometres), floes that share an edge would overlap.
inline constexpr double kTouchingDepth = 1e-9;
/// Area below which an exactly computed overlap counts as the rounding of a shared edge [m²]: an edge of one kilometre
/// times kTouchingDepth.
inline constexpr double kTouchingArea = 1e-6;

struct OverlappingPair {
  std::size_t first = 0;  ///< lower index
  std::size_t second = 0;
  double area = 0;  ///< [m²]
};

/// Returns the pairs of polygons that share area, ordered by their indices; shared edges and corners do not count. All
/// polygons must be valid. A tree of boxes finds candidates (in nearly linear time for fields of ice), a separating
/// edge decides most of them, and an exact cut the rest. Stops after `most` pairs.
std::vector<OverlappingPair> find_overlapping_pairs(const std::vector<Polygon>& polygons, std::size_t most);

/// The rest of a polygon after parts that larger polygons overlap have been removed.
struct Trimmed {
  std::vector<Polygon> pieces;      ///< valid; the polygon itself if nothing overlaps it; empty if all of it is removed
  std::vector<std::size_t> yields;  ///< polygons to which it yields, ascending
  double area_trimmed = 0;          ///< Σ exact areas removed, slivers included [m²]
  double rounding_defect = 0;       ///< Σ over the cuts: pieces as returned − exact pieces [m²]
  std::optional<CutError> error;    ///< error of a cut that geometry refused; the pieces are then empty
};

/// Makes polygons disjoint: area that two share stays with the larger one, or of equal ones with the first. With a gap
/// [m], everything closer to the larger polygon than the gap is cut off too, up to 4 % farther at its corners. Shared
/// areas of at most kTouchingArea are the rounding of shared edges and stay. All polygons must be valid. Each polygon
/// is cut exactly, by the others one after another.
std::vector<Trimmed> make_disjoint(const std::vector<Polygon>& polygons, double gap);

/// The place and time of the first contact between two outlines that move in straight lines without turning.
struct FirstContact {
  double time = 0;  ///< from now on [s]
  Point point;      ///< present place of the touching point of a [m]
  Vector normal;    ///< unit vector from a into b
};

/// Returns the first contact of `a` and `b` at a time in [from, until] [s], with b moving at `velocity` relative to a
/// [m/s]. Both outlines are counter-clockwise and in one frame. A time below 0 lies in the past. Returns nullopt for
/// outlines that only slide along each other.
std::optional<FirstContact> first_contact(const Ring& a, const Ring& b, Vector velocity, double from, double until);

}  // namespace polynya::geometry
