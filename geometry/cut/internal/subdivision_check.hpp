#pragma once

#include <vector>

#include "geometry/cut/internal/cut_pieces.hpp"

namespace polynya::geometry {

/// After rounding, do the edges of the cut shape still meet in shared ends only? `near_tool` are the shape's
/// edges that overlap `tool_box`. Exact.
bool changed_edges_are_apart(const LocalCut& cut, const Box& tool_box, const std::vector<EdgeId>& near_tool);

}  // namespace polynya::geometry
