#pragma once

#include <string>

#include "geometry/cut/cut.hpp"
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

/// The area of overlap() of two valid polygons [m²], found from the near part of the longer one and all of
/// the other.
tl::expected<double, CutError> shared_area(const Polygon& a, const Pose& world_from_a, const Polygon& b,
                                           const Pose& world_from_b);

/// Whether `a` has an edge with all of `a` on its left and all of `b` on its right. Vertices of `a` may lie
/// beyond it by so much, those of `b` by so much [m]; a negative one keeps them off it.
bool has_separating_edge(const Ring& a, const Ring& b, double most_of_a, double most_of_b);

/// The ring with vertices left out such that it winds around every point of the box as before. A run of
/// vertices that all lie beyond one side of the box may be drawn straight without passing over it. Elsewhere
/// the result may cross itself. Few vertices are left of a long ring beside a small box.
Ring near_part(const Ring& ring, const Box& box);

}  // namespace polynya::geometry
