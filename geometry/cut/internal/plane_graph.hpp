#pragma once

#include <cstddef>
#include <vector>

#include "geometry/cut/internal/arrangement.hpp"

namespace polynya::geometry::exact {

/// The subdivision of the plane by segments, as plain lists. Half-edges 2i and 2i + 1 are the two sides of
/// edge i; each has its face on the left.
struct PlaneGraph {
  std::vector<Point> points;                      ///< of the vertices
  std::vector<int> origin;                        ///< of each half-edge: its first vertex
  std::vector<int> next;                          ///< of each half-edge: the one that follows around its face
  std::vector<std::vector<std::size_t>> sources;  ///< of each edge: the segments that run along it
  std::vector<char> is_rightward;                 ///< of each half-edge: lexicographically upwards

  int half_edge_count() const { return static_cast<int>(origin.size()); }
  int target(int half_edge) const { return origin[static_cast<std::size_t>(half_edge ^ 1)]; }
};

/// By CGAL's arrangement. Segments may cross, touch, overlap and repeat. Throws std::exception where CGAL
/// refuses.
PlaneGraph plane_graph(const std::vector<SourceSegment>& segments);

/// Does the segment run in the direction that `is_rightward` means?
bool runs_rightward(const SourceSegment& segment);

}  // namespace polynya::geometry::exact
