#pragma once

#include <optional>
#include <vector>

#include "geometry/cut/internal/cut_faces.hpp"
#include "geometry/exact/internal/areas.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"

namespace polynya::geometry {

/// An edge of the cut shape, and which of its ends are rounded nodes.
struct Segment {
  Point from;
  Point to;
  bool from_is_rounded = false;
  bool to_is_rounded = false;
};

/// One ring of a piece: a loop of the graph, a ring of the shape the cut left alone, or the whole tool.
struct PieceRing {
  enum class Source { kLoop, kShapeRing, kTool, kToolReversed };
  Source source = Source::kLoop;
  Loop loop;           ///< for kLoop
  int shape_ring = 0;  ///< for kShapeRing
  Ring points;         ///< written out, new vertices rounded
  RingArea area;       ///< of `points`
};

struct PiecePlan {
  std::vector<PieceRing> rings;  ///< the outer one first
  Part part = Part::kOutside;
};

/// The state of a local cut.
struct LocalCut {
  const Rings& rings;
  const Tool& tool;
  std::vector<Node> nodes;
  CutGraph graph;
  std::vector<Segment> changed;  ///< edges that end in a rounded node
  std::vector<Segment> placed;   ///< the other new edges: along the tool, and parts of the shape's edges
};

/// Writes out all rings and finds which bound which piece. None where that is in doubt.
std::optional<std::vector<PiecePlan>> plan_pieces(LocalCut& cut);

/// A piece before rounding.
exact::Polygon write_exactly(const LocalCut& cut, const PiecePlan& plan);

/// Could rounding the changed edges have carried one of them across a whole ring of the piece?
bool may_have_swept_a_ring(const LocalCut& cut, const PiecePlan& plan);

/// After rounding, do the edges of the cut shape still meet in shared ends only? `near_tool` are the shape's
/// edges that overlap `tool_box`. Exact.
bool changed_edges_are_apart(const LocalCut& cut, const Box& tool_box, const std::vector<EdgeId>& near_tool);

}  // namespace polynya::geometry
