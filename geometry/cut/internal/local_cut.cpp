#include "geometry/cut/internal/local_cut.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cut/internal/cut_paths.hpp"
#include "geometry/cut/internal/snap_rounding.hpp"
#include "geometry/exact/point_in_ring.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry {
namespace {

using exact::Rational;

// Do two different rings of a valid polygon meet in a point? Exact.
bool has_touching_rings(const Polygon& polygon) {
  if (polygon.holes.empty()) return false;
  const std::vector<Edge> edges = edges_of(polygon);
  return !BoxTree(edges).for_each_pair([&](std::size_t i, std::size_t j) {
    const Edge& e = edges[i];
    const Edge& f = edges[j];
    return e.ring == f.ring || meet(e.a, e.b, f.a, f.b).kind == Meeting::kNone;
  });
}

// Twice the area between the straight edge that starts at `a` and the chain of points it was split into, with
// the edge's own end last: zero where all points lie on it.
Rational twice_area_between(const exact::Point& a, const std::vector<exact::Point>& chain) {
  Rational sum = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const exact::Point& p = chain[i - 1];
    const exact::Point& q = chain[i];
    sum += (p.x - a.x) * (q.y - a.y) - (p.y - a.y) * (q.x - a.x);
  }
  return sum;
}

// Σ pieces − shape, in shoelace terms: every chain of the shape is in the pieces once, every chord once
// in each direction, where its terms cancel; untouched rings are carried over. What is left is each split
// edge against the sub-edges it became, and that is summed here in rationals: before rounding it must be
// zero for every edge by itself. Returns twice the area that rounding the nodes adds; none where a sum is not
// zero.
std::optional<Rational> check_split_edges(const LocalCut& cut) {
  Rational rounding = 0;
  for (std::size_t begin = 0; begin < cut.nodes.size();) {
    const Place& place = cut.nodes[begin].on_shape;
    std::size_t end = begin;
    std::vector<exact::Point> exactly;
    std::vector<exact::Point> rounded;
    for (; end < cut.nodes.size() && cut.nodes[end].on_shape == place; ++end) {
      const Node& node = cut.nodes[end];
      if (!node.is_active || place.at_vertex) continue;
      exactly.push_back(exact_point(node));
      rounded.push_back(exact::exactly(node.at));
    }
    begin = end;
    if (exactly.empty()) continue;
    const exact::Point a = exact::exactly(cut.rings.point(place.ring, place.edge));
    const exact::Point b = exact::exactly(cut.rings.point(place.ring, place.edge + 1));
    exactly.push_back(b);
    rounded.push_back(b);
    if (twice_area_between(a, exactly) != 0) return {};
    rounding += twice_area_between(a, rounded);
  }
  return rounding;
}

// The pieces as planned, where rounding broke none of them.
CutResult take_as_planned(std::vector<PiecePlan> plans, double area_before, const Rational& rounding) {
  CutResult result;
  CutLedger& ledger = result.ledger;
  ledger.area_before = area_before;
  ledger.exact_balance = true;
  ledger.exact_defect = "0";  // checked edge by edge
  ledger.rounding_defect = exact::nearest_double(rounding / 2);
  for (PiecePlan& plan : plans) {
    Piece piece{Shape{{}, true}, plan.part};
    std::vector<RingArea> areas;
    Polygon& polygon = piece.shape.polygon;
    for (PieceRing& ring : plan.rings) {
      areas.push_back(ring.area);
      (polygon.outer.empty() ? polygon.outer : polygon.holes.emplace_back()) = std::move(ring.points);
    }
    (plan.part == Part::kOutside ? ledger.area_outside : ledger.area_inside) += area_of(polygon, areas);
    result.pieces.push_back(std::move(piece));
  }
  exact::sort_pieces(result.pieces);
  return result;
}

// The pieces rounded from their exact shapes, where it did.
CutOutcome round_exactly(const LocalCut& cut, const std::vector<PiecePlan>& plans, const Polygon& shape) {
  std::vector<exact::ExactPiece> pieces;
  pieces.reserve(plans.size());
  for (const PiecePlan& plan : plans) pieces.push_back({write_exactly(cut, plan), plan.part});
  return exact::rounded_pieces(exact::area(shape), pieces);
}

// Is every half-edge in the written pieces exactly once, and every ring of the shape?
bool uses_all_once(const LocalCut& cut, const std::vector<PiecePlan>& plans) {
  std::vector<int> uses(cut.graph.half_edges.size(), 0);
  std::vector<int> ring_uses(cut.graph.ring_is_cut.begin(), cut.graph.ring_is_cut.end());
  for (const PiecePlan& plan : plans) {
    for (const PieceRing& ring : plan.rings) {
      if (ring.source == PieceRing::Source::kShapeRing) ++ring_uses[static_cast<std::size_t>(ring.shape_ring)];
      for (const int h : ring.loop) ++uses[static_cast<std::size_t>(h)];
    }
  }
  const auto once = [](int count) { return count == 1; };
  return std::all_of(uses.begin(), uses.end(), once) && std::all_of(ring_uses.begin(), ring_uses.end(), once);
}

double length_along(const Tool& tool, int first, int last) {
  double sum = 0;
  for (int i = first; i < last; ++i) sum += distance(tool.point(i), tool.point(i + 1));
  return sum;
}

// An open tool that does not touch itself separates all the way between its nodes, bridges apart: only those
// and what comes before the first and after the last dangle.
double dangling_length(const LocalCut& cut, const Polygon& shape) {
  const int last_vertex = static_cast<int>(cut.tool.points.size()) - 1;
  if (cut.nodes.empty()) {
    return contains_strictly(shape, cut.tool.points.front()) ? length_along(cut.tool, 0, last_vertex) : 0;
  }
  double sum = 0;
  if (cut.graph.starts_inside) {
    const Node& node = cut.nodes[static_cast<std::size_t>(cut.graph.first_node)];
    sum += length_along(cut.tool, 0, node.on_tool.edge) + distance(cut.tool.point(node.on_tool.edge), node.at);
  }
  if (cut.graph.ends_inside) {
    const Node& node = cut.nodes[static_cast<std::size_t>(cut.graph.last_node)];
    const int next = node.on_tool.edge + 1;
    sum += distance(node.at, cut.tool.point(next)) + length_along(cut.tool, next, last_vertex);
  }
  for (const HalfEdge& bridge : cut.graph.bridges) {
    Point from = cut.nodes[static_cast<std::size_t>(bridge.from)].at;
    for (int i = 0; i < bridge.run.count; ++i) {
      const Point to = cut.tool.point(bridge.run.first + i);
      sum += distance(from, to);
      from = to;
    }
    sum += distance(from, cut.nodes[static_cast<std::size_t>(bridge.to)].at);
  }
  return sum;
}

// No chord: the tool runs past the ice, ends in it, or one lies within the other.
enum class Apart { kUncovered, kMisses, kToolInShape, kShapeInTool, kEndsInside };

Apart relate_apart(const LocalCut& cut, const Polygon& shape) {
  if (!cut.tool.is_closed) {
    const bool enters = cut.nodes.empty()
                            ? contains_strictly(shape, cut.tool.points.front())
                            : cut.graph.starts_inside || cut.graph.ends_inside || !cut.graph.bridges.empty();
    return enters ? Apart::kEndsInside : Apart::kMisses;
  }
  if (cut.nodes.empty()) {
    if (contains_strictly(shape, cut.tool.points.front())) return Apart::kToolInShape;
    return side_of_ring(cut.tool.points, shape.outer.front()) > 0 ? Apart::kShapeInTool : Apart::kMisses;
  }
  // Touching: a vertex of the shape that is off the tool's boundary decides; without one, the general path.
  for (const Point p : shape.outer) {
    const int side = side_of_ring(cut.tool.points, p);
    if (side != 0) return side > 0 ? Apart::kShapeInTool : Apart::kMisses;
  }
  return Apart::kUncovered;
}

CutResult whole_shape_inside(const Polygon& shape) {
  CutResult result;
  result.pieces.push_back({Shape{shape, true}, Part::kInside});
  result.ledger.area_before = result.ledger.area_inside = area_of(shape);
  result.ledger.exact_balance = true;
  result.ledger.exact_defect = "0";  // the one piece is the shape itself
  return result;
}

bool is_cleanly_rounded(const LocalCut& cut, const std::vector<PiecePlan>& plans, const Box& tool_box,
                        const std::vector<EdgeId>& near_tool) {
  if (!changed_edges_are_apart(cut, tool_box, near_tool)) return false;
  for (const PiecePlan& plan : plans) {
    if (may_have_swept_a_ring(cut, plan)) return false;
    for (std::size_t r = 0; r < plan.rings.size(); ++r) {
      const RingArea& area = plan.rings[r].area;
      if (!((r == 0 ? area.area : -area.area) > area.doubt)) return false;
    }
  }
  return true;
}

// Does the cut join no rings, or none that could pinch? A chord between two rings makes one boundary of both,
// and where they touched already that boundary touches itself, away from all nodes.
bool joins_no_touching_rings(const LocalCut& cut, const Polygon& shape) {
  return cut.graph.rings_met <= 1 || !has_touching_rings(shape);
}

}  // namespace

std::optional<CutOutcome> cut_locally(const Polygon& shape, const Tool& tool) {
  const Rings rings(shape);
  const Box tool_box = bounding_box(tool.points);
  const std::vector<EdgeId> near_tool = edges_near(rings, tool_box);
  std::optional<std::vector<Node>> nodes = find_nodes(rings, tool, near_tool);
  if (!nodes) return {};
  LocalCut cut{rings, tool, std::move(*nodes), {}, {}, {}};
  cut.graph = trace_faces(rings, tool, cut.nodes);
  if (!cut.graph.is_consistent || !joins_no_touching_rings(cut, shape)) return {};
  if (cut.graph.walks.empty()) {
    switch (relate_apart(cut, shape)) {
      case Apart::kUncovered:
        return {};
      case Apart::kMisses:
        return refuse(CutFailure::kMisses, "the tool does not meet the shape's interior");
      case Apart::kEndsInside:
        return tl::unexpected(
            CutError{CutFailure::kDoesNotSeparate, "the crack ends inside the ice", dangling_length(cut, shape)});
      case Apart::kShapeInTool:
        return whole_shape_inside(shape);
      case Apart::kToolInShape:
        break;
    }
  }
  std::optional<std::vector<PiecePlan>> plans = plan_pieces(cut);
  if (!plans || !uses_all_once(cut, *plans)) return {};
  const std::optional<Rational> rounding = check_split_edges(cut);
  if (!rounding) return refuse(CutFailure::kInternal, "a split edge does not sum to itself");
  CutOutcome outcome = is_cleanly_rounded(cut, *plans, tool_box, near_tool)
                           ? take_as_planned(std::move(*plans), area_of(shape), *rounding)
                           : round_exactly(cut, *plans, shape);
  if (outcome && !tool.is_closed) outcome->ledger.dangling_length = dangling_length(cut, shape);
  return outcome;
}

}  // namespace polynya::geometry
