#include "geometry/cut/internal/window_cut.hpp"

#include <algorithm>
#include <set>

#include "geometry/cut/internal/planned_pieces.hpp"
#include "geometry/cut/internal/subdivision_check.hpp"
#include "geometry/cut/internal/window_pieces.hpp"

namespace polynya::geometry {
namespace {

using exact::Rational;
using exact::SourceSegment;
using exact::Winding;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

tl::unexpected<CutError> refuse(CutFailure reason, std::string detail) {
  return tl::unexpected(CutError{reason, std::move(detail)});
}

// Far chains and far rings stand in the pieces once each, as they stand in the shape: what is left to sum is
// what was arranged.
AreaCheck balance_window(const WindowCut& cut, const std::vector<WindowPiece>& pieces) {
  AreaCheck balance;
  for (const EdgeId e : cut.window.near)
    balance.defect -=
        shoelace_term(cut.shape.exact_point(e.ring, e.index), cut.shape.exact_point(e.ring, e.index + 1));
  for (const WindowPiece& piece : pieces) {
    for (const WindowPieceRing& ring : piece.rings) {
      for_each_near_edge(ring.steps, [&](int from, int to) {
        const Rational term =
            shoelace_term(cut.overlay.graph.points[at(from)], cut.overlay.graph.points[at(to)]);
        balance.defect += term;
        if (cut.is_rounded[at(from)] == 0 && cut.is_rounded[at(to)] == 0) return;
        balance.rounding +=
            shoelace_term(exact::exactly(cut.nearest[at(from)]), exact::exactly(cut.nearest[at(to)])) - term;
      });
    }
  }
  return balance;
}

// Is every far chain and far ring in the pieces exactly once, along its own direction?
bool uses_all_far_once(const WindowCut& cut, const std::vector<WindowPiece>& pieces) {
  std::vector<int> chain_uses(cut.window.chains.size(), 0);
  std::size_t far_rings = 0;
  for (const WindowPiece& piece : pieces) {
    for (const WindowPieceRing& ring : piece.rings) {
      far_rings += ring.far_ring >= 0 ? 1 : 0;
      for (const WindowStep& step : ring.steps) {
        if (step.chain >= 0) chain_uses[at(step.chain)] += step.is_forward ? 1 : 2;
      }
    }
  }
  return far_rings == cut.window.far_rings.size() &&
         std::all_of(chain_uses.begin(), chain_uses.end(), [](int uses) { return uses == 1; });
}

// The pieces' new edges, each once, sorted by whether rounding changed them.
struct NewEdges {
  std::vector<Segment> changed;
  std::vector<Segment> placed;
  std::vector<Point> rounded_nodes;
};

NewEdges new_edges(const WindowCut& cut, const std::vector<WindowPiece>& pieces) {
  NewEdges edges;
  std::set<std::pair<int, int>> seen;
  std::vector<char> is_noted(cut.nearest.size(), 0);
  const auto note = [&](int v) {
    if (cut.is_rounded[at(v)] == 0 || is_noted[at(v)] != 0) return;
    is_noted[at(v)] = 1;
    edges.rounded_nodes.push_back(cut.nearest[at(v)]);
  };
  for (const WindowPiece& piece : pieces) {
    for (const WindowPieceRing& ring : piece.rings) {
      for_each_near_edge(ring.steps, [&](int from, int to) {
        note(from);
        note(to);
        if (!seen.insert(std::minmax(from, to)).second) return;
        const bool from_is_rounded = cut.is_rounded[at(from)] != 0;
        const bool to_is_rounded = cut.is_rounded[at(to)] != 0;
        (from_is_rounded || to_is_rounded ? edges.changed : edges.placed)
            .push_back({cut.nearest[at(from)], cut.nearest[at(to)], from_is_rounded, to_is_rounded});
      });
    }
  }
  return edges;
}

std::vector<Segment> far_edges_near(const WindowCut& cut, const std::vector<Segment>& changed) {
  Ring ends;
  for (const Segment& s : changed) {
    ends.push_back(s.from);
    ends.push_back(s.to);
  }
  const auto less = [](EdgeId a, EdgeId b) { return a.ring != b.ring ? a.ring < b.ring : a.index < b.index; };
  std::vector<EdgeId> arranged = cut.window.near;
  std::sort(arranged.begin(), arranged.end(), less);
  std::vector<Segment> far;
  const Rings& rings = cut.shape;
  for (const EdgeId e : edges_near(rings, bounding_box(ends))) {
    if (std::binary_search(arranged.begin(), arranged.end(), e, less)) continue;
    far.push_back({rings.point(e.ring, e.index), rings.point(e.ring, e.index + 1)});
  }
  return far;
}

bool is_cleanly_rounded(const WindowCut& cut, const std::vector<WindowPiece>& pieces) {
  NewEdges edges = new_edges(cut, pieces);
  if (edges.changed.empty()) return true;
  if (!are_distinct(std::move(edges.rounded_nodes)) || !changed_edges_are_apart(edges.changed)) return false;
  if (!are_clear_of(edges.changed, edges.placed)) return false;
  if (!are_clear_of(edges.changed, far_edges_near(cut, edges.changed))) return false;
  for (const WindowPiece& piece : pieces) {
    for (const WindowPieceRing& ring : piece.rings) {
      if (!(ring.turn * ring.area.area > ring.area.doubt)) return false;
      if (piece.rings.size() > 1 && may_have_swept(edges.changed, bounding_box(ring.points))) return false;
    }
  }
  return true;
}

void round_vertices(WindowCut& cut) {
  for (const exact::Point& p : cut.overlay.graph.points) {
    cut.nearest.push_back(exact::rounded(p));
    cut.is_rounded.push_back(exact::exactly(cut.nearest.back()) == p ? 0 : 1);
  }
}

std::optional<CutOutcome> round_in_window(WindowCut& cut, const exact::Classifier& classify,
                                          bool must_separate) {
  round_vertices(cut);
  std::optional<std::vector<WindowPiece>> plans = plan_pieces(cut, classify);
  if (!plans || !uses_all_far_once(cut, *plans)) return {};
  if (must_separate && plans->size() < 2) {
    return tl::unexpected(CutError{CutFailure::kDoesNotSeparate,
                                   "the crack ends inside the ice or only bridges its holes",
                                   cut.overlay.dangling_length});
  }
  const AreaCheck balance = balance_window(cut, *plans);
  if (balance.defect != 0) return {};
  if (!is_cleanly_rounded(cut, *plans)) return round_exactly(cut, *plans, exact::area(cut.shape.polygon()));
  return take_as_planned(std::move(*plans), area_of(cut.shape.polygon()), balance);
}

bool has_inside(const WindowCut& cut, const exact::Classifier& classify) {
  for (const RegionBoundary& boundary : cut.overlay.boundaries) {
    if (boundary.label == 1) return true;
  }
  if (cut.window.far_rings.empty() || cut.window.far_rings.front() != 0) return false;
  return classify({1, winding_left_of(cut.tool, cut.shape.exact_point(0, 0))}) == 1;
}

}  // namespace

std::optional<CutOutcome> cut_by_polygons_in_window(const Shape& shape,
                                                    const std::vector<Polygon>& tools_in_body) {
  const Rings rings(shape.polygon);
  const Box box = bounding_box(shape.polygon.outer);
  std::vector<SourceSegment> tool;
  for (const Polygon& polygon : tools_in_body) {
    if (overlaps(bounding_box(polygon.outer), box)) append_segments(tool, exact::exactly(polygon), 1);
  }
  if (tool.empty()) return refuse(CutFailure::kMisses, "the polygon does not meet the shape's interior");
  const exact::Classifier classify = [](Winding w) { return w.shape <= 0 ? -1 : (w.tool > 0 ? 1 : 0); };
  const Window window = open_window(rings, tool);
  std::optional<WindowOverlay> overlay =
      overlay_in_window(rings, window, tool, classify, exact::Seams::kDissolve);
  if (!overlay) return {};
  WindowCut cut{rings, window, tool, std::move(*overlay), {}, {}};
  if (!has_inside(cut, classify))
    return refuse(CutFailure::kMisses, "the polygon does not meet the shape's interior");
  return round_in_window(cut, classify, false);
}

std::optional<CutOutcome> cut_along_in_window(const Shape& shape,
                                              const std::vector<Point>& polyline_in_body) {
  const Rings rings(shape.polygon);
  std::vector<SourceSegment> tool;
  for (std::size_t i = 1; i < polyline_in_body.size(); ++i) {
    const Point from = polyline_in_body[i - 1];
    const Point to = polyline_in_body[i];
    if (from != to) tool.push_back({exact::exactly(from), exact::exactly(to), 1});
  }
  if (tool.empty()) return refuse(CutFailure::kMisses, "the crack has no length");
  const exact::Classifier classify = [](Winding w) { return w.shape <= 0 ? -1 : 0; };
  const Window window = open_window(rings, tool);
  std::optional<WindowOverlay> overlay =
      overlay_in_window(rings, window, tool, classify, exact::Seams::kKeep);
  if (!overlay) return {};
  WindowCut cut{rings, window, tool, std::move(*overlay), {}, {}};
  if (!cut.overlay.tool_meets_interior)
    return refuse(CutFailure::kMisses, "the crack does not meet the shape's interior");
  std::optional<CutOutcome> outcome = round_in_window(cut, classify, true);
  if (outcome && *outcome) (*outcome)->ledger.dangling_length = cut.overlay.dangling_length;
  return outcome;
}

}  // namespace polynya::geometry
