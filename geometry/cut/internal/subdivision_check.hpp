#pragma once

#include <vector>

#include "geometry/cut/internal/cut_pieces.hpp"

namespace polynya::geometry {

/// No point twice?
bool are_distinct(std::vector<Point> points);

/// Has every changed edge a length, and do they meet in shared ends only? Exact.
bool changed_edges_are_apart(const std::vector<Segment>& changed);

/// Do the changed edges meet these others in shared ends only? Exact.
bool are_clear_of(const std::vector<Segment>& changed, const std::vector<Segment>& others);

/// After rounding, do the edges of the cut shape still meet in shared ends only? `near_tool` are the shape's
/// edges that overlap `tool_box`. Exact.
bool changed_edges_are_apart(const LocalCut& cut, const Box& tool_box, const std::vector<EdgeId>& near_tool);

}  // namespace polynya::geometry
