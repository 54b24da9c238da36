#pragma once

#include <vector>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/cut_nodes.hpp"

namespace polynya::geometry {

/// A stretch of a ring that the cut leaves as it is: `count` edges from vertex `first` on.
struct FarChain {
  int ring = 0;
  int first = 0;
  int count = 0;
};

/// The edges of a shape that a tool may change or join, and all others as whole stretches. No far edge meets
/// the tool or an edge of another ring.
struct Window {
  std::vector<EdgeId> near;       ///< in order along the rings
  std::vector<int> chain_after;   ///< of each near edge: the far chain that starts where it ends, or −1
  std::vector<int> chain_before;  ///< and the one that ends where it starts
  std::vector<FarChain> chains;
  std::vector<int> far_rings;  ///< rings without any near edge
};

/// One look at every vertex and, where the shape has holes, at the pairs of edges of different rings whose
/// boxes overlap.
Window open_window(const Rings& shape, const std::vector<exact::SourceSegment>& tool);

}  // namespace polynya::geometry
