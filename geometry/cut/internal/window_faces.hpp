#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/internal/plane_graph.hpp"
#include "geometry/cut/internal/window.hpp"

namespace polynya::geometry {

/// A step along the boundary of a region: to a vertex of the graph, or along a whole far chain, whose inner
/// vertices come next.
struct WindowStep {
  int vertex = -1;
  int chain = -1;
  bool is_forward = true;  ///< of a chain
};
using WindowRing = std::vector<WindowStep>;

/// Rings that bound one region and hang together in the graph: one outer ring with touching holes, or holes
/// only.
struct RegionBoundary {
  std::vector<WindowRing> rings;
  int label = 0;
  int component = 0;  ///< of the graph
};

/// The overlay of a whole shape with a tool, of which only the window was arranged.
struct WindowOverlay {
  exact::PlaneGraph graph;
  std::vector<RegionBoundary> boundaries;
  bool tool_meets_interior = false;
  double dangling_length = 0;  ///< [m]
  int component_count = 0;
};

/// What exact::overlay gives, up to the far rings and to which holes belong to which region. The tool's
/// segments wind (polygons) or do not (a crack). None where the graph is not what a valid shape makes.
std::optional<WindowOverlay> overlay_in_window(const Rings& shape, const Window& window,
                                               const std::vector<exact::SourceSegment>& tool,
                                               const exact::Classifier& classify, exact::Seams seams);

/// How often the tool's closed curves wind around the point, which is on none of them, or, where curves start
/// at it, around the points just left of it.
int winding_left_of(const std::vector<exact::SourceSegment>& tool, const exact::Point& p);

}  // namespace polynya::geometry
