#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/contact/boundary.hpp"

namespace polynya::geometry {

// Search for the parts of two boundaries that are near each other, and a test whether two bodies share a point at all.

/// A pair of edges (or of bounding circles) of two boundaries that are near each other.
struct NearPair {
  std::uint32_t a = 0;
  std::uint32_t b = 0;
  friend auto operator<=>(const NearPair&, const NearPair&) = default;
};

/// Pairs of edges that are near each other, with the ends of the edges, each in the frame of its boundary.
struct NearEdges {
  std::vector<NearPair> pairs;
  /// Eight columns of `stride` numbers: x and y of the first end of a's edges, of the second, and the same of b's [m].
  std::vector<double> ends;
  std::size_t stride = 0;  ///< at least one for each pair; a multiple of 4
};

/// Finds all pairs of bounding circles of two boundaries within `margin` of each other [m], and thereby all near
/// pieces. Appends to `circle_pairs`. Returns a lower bound of the distance between the boundaries [m], which is useful
/// if nothing is within the margin.
double near_circles(const Covered& a, const Covered& b, const Pose& a_from_b, double margin,
                    std::vector<NearPair>& circle_pairs);

/// Number of edges of two boundaries together up to which near_edges() compares them without a tree [-]. Its stack has
/// room for that many points. More: the comparison costs their product. Fewer: covers are made for bodies that do not
/// need them.
inline constexpr std::size_t kFewEdges = 256;
inline bool have_few_edges(const EdgeList& a, const EdgeList& b) {
  return a.size() + b.size() <= kFewEdges;
}

/// Finds the pairs of edges within `margin` of each other [m], in order, of two boundaries with few edges
/// (have_few_edges). Returns a lower bound of the distance between the boundaries [m], which is useful if nothing is
/// within the margin.
double near_edges(const EdgeList& a, const EdgeList& b, const Pose& a_from_b, double margin, NearEdges& edges);

/// Finds the pairs of edges on the pieces of pairs of bounding circles, each once, in order.
void edges_of(const Covered& a, const Covered& b, const std::vector<NearPair>& circle_pairs, NearEdges& edges);

/// Returns true if one of two boundaries that do not cross lies inside the other.
bool is_one_inside(const EdgeList& a, const EdgeList& b, const Pose& a_from_b);
bool is_one_inside(const Covered& a, const Covered& b, const Pose& a_from_b);

/// Returns the smallest distance between the edges of the pairs; 0 if two cross or touch [m].
double least_distance(const Pose& a_from_b, const NearEdges& edges);

/// Returns true if two bodies share no point, in plain doubles: no edges cross or touch, and neither is inside the
/// other. The edges of a boundary suffice; it need not be ready. Of a's edges only those in the box of b are compared
/// with b's, so b should be the smaller one. Within rounding of a touch the result may be either.
bool is_clear(const Boundary& a, const Boundary& b, const Pose& a_from_b);

}  // namespace polynya::geometry
