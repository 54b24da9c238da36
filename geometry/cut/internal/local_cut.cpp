#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>

#include "geometry/cut/internal/cut_graph.hpp"
#include "geometry/cut/internal/snap_rounding.hpp"
#include "geometry/exact/internal/exact_polygon.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry {
namespace {

/// An edge of the cut shape, and which of its ends are rounded nodes.
struct Segment {
  Point from;
  Point to;
  bool from_is_rounded = false;
  bool to_is_rounded = false;
};
Box box_of(const Segment& s) {
  return box_around(s.from, s.to);
}

/// One ring of a piece: a loop of the graph, a ring of the shape that the cut does not touch, or the whole tool.
struct PieceRing {
  PieceRing(Ring written, Loop of_loop, int ring_of_shape)
      : points(std::move(written)), loop(std::move(of_loop)), shape_ring(ring_of_shape), area(ring_area(points)) {}
  Ring points;     ///< its points, with new vertices rounded
  Loop loop;       ///< empty for a whole ring
  int shape_ring;  ///< −1: it is not a ring of the shape
  RingArea area;   ///< of `points`
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

// ---- pieces: the rings that bound them

// Calls on_node(node, half-edge) and on_run(first, last, half-edge) for a loop's vertices in order. The half-edge is
// the one along which the loop leaves them; [first, last) are iterators over points.
template <typename OnNode, typename OnRun>
void for_each_stretch(const LocalCut& cut, const Loop& loop, OnNode on_node, OnRun on_run) {
  for (const int h : loop) {
    const HalfEdge& e = cut.graph.half_edges[h];
    on_node(cut.nodes[e.from], e);
    const Ring& points = e.is_chord ? cut.tool.points : cut.rings[e.ring];
    const auto begin = points.begin() + e.run.first;
    const auto before_wrap = std::min<std::ptrdiff_t>(e.run.count, points.end() - begin);
    const auto wrapped_end = points.begin() + (e.run.count - before_wrap);
    if (e.is_forward) {
      on_run(begin, begin + before_wrap, e);
      on_run(points.begin(), wrapped_end, e);
    } else {
      on_run(std::make_reverse_iterator(wrapped_end), points.rend(), e);
      on_run(std::make_reverse_iterator(begin + before_wrap), std::make_reverse_iterator(begin), e);
    }
  }
}

// Writes a loop's vertices and records the new edges; edges of a chord are recorded once, on its forward side.
Ring write_loop(LocalCut& cut, const Loop& loop) {
  struct Vertex {
    bool is_node = false;
    bool is_rounded = false;
    const HalfEdge* leaves_along;
  };
  Ring points;
  std::size_t count = loop.size();
  for (const int h : loop) count += static_cast<std::size_t>(cut.graph.half_edges[h].run.count);
  points.reserve(count);
  Vertex first{true, false, &cut.graph.half_edges[loop.front()]};
  Vertex last = first;
  const auto note_edge = [&](Point to, const Vertex& v) {
    if (last.leaves_along->is_chord && !last.leaves_along->is_forward) return;
    (last.is_rounded || v.is_rounded ? cut.changed : cut.placed)
        .push_back({points.back(), to, last.is_rounded, v.is_rounded});
  };
  const auto append = [&](Point p, const Vertex& v) {
    if (points.empty()) {
      first = v;
    } else if (last.is_node || v.is_node || last.leaves_along->is_chord) {
      note_edge(p, v);
    }
    points.push_back(p);
    last = v;
  };
  const auto append_run = [&](auto from, auto to, const HalfEdge& e) {
    if (e.is_chord) {
      for (; from != to; ++from) append(*from, {false, false, &e});
    } else if (from != to) {
      append(*from, {false, false, &e});
      points.insert(points.end(), ++from, to);
    }
  };
  for_each_stretch(
      cut, loop,
      [&](const Node& node, const HalfEdge& e) {
        append(node.at, {true, node.is_rounded, &e});
      },
      append_run);
  note_edge(points.front(), first);
  return points;
}

exact::Ring write_exactly(const LocalCut& cut, const PieceRing& ring) {
  if (ring.loop.empty()) return exact::exactly(ring.points);
  exact::Ring points;
  for_each_stretch(
      cut, ring.loop, [&](const Node& node, const HalfEdge&) { points.push_back(exact_point(node)); },
      [&](auto from, auto to, const HalfEdge&) {
        for (; from != to; ++from) points.push_back(exact::exactly(*from));
      });
  return points;
}

// Returns 1 if the exact loop runs counter-clockwise, −1 if clockwise, 0 if it has no area. The area of the rounded
// loop decides if it exceeds the error of its sum and twice the change by rounding its vertices (RingArea::step_area);
// otherwise the exact area is computed.
int orientation_of(const LocalCut& cut, const PieceRing& ring) {
  const double clear = ring.area.doubt + 2 * ring.area.step_area;
  if (ring.area.area > clear) return 1;
  if (-ring.area.area > clear) return -1;
  return exact::sign(exact::area(write_exactly(cut, ring)));
}

// Returns an upper bound of the distance by which rounding can have moved the ends of an edge: 4 spacings of doubles at
// its coordinates, while rounding moves them by half a spacing.
double reach(const Segment& s) {
  const double size = std::max({std::abs(s.from.x), std::abs(s.from.y), std::abs(s.to.x), std::abs(s.to.y)});
  return 4 * (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
}

// Returns a box that contains the edge before and after its ends were rounded.
Box swept_box(const Segment& s) {
  return grown(box_of(s), reach(s));
}

// Returns true if a point is so near to a changed edge that the rounded and the exact edge may have it on different
// sides. (An edge that ends in p does not count, because p is not on the tested ring then.) The threshold is 8 times
// the possible displacement, well above the rounding errors of the product.
bool is_doubtful(const LocalCut& cut, Point p) {
  return std::ranges::any_of(cut.changed, [&](const Segment& s) {
    if (p == s.from || p == s.to || !overlaps(swept_box(s), {p, p})) return false;
    const Vector along = s.to - s.from;
    return std::abs(cross(along, p - s.from)) <= 8 * reach(s) * (std::abs(along.x) + std::abs(along.y) + reach(s));
  });
}

// Returns whether a hole lies inside a shell. It tests a vertex of the hole far from all changed edges, where the
// rounded and the exact rings agree. Returns nullopt if that is in doubt.
std::optional<bool> is_inside(const LocalCut& cut, const Ring& hole, const Ring& shell) {
  bool all_on_shell = true;
  for (const Point p : hole) {
    const int side = side_of_ring(shell, p);
    all_on_shell = all_on_shell && side == 0;
    if (side != 0 && !is_doubtful(cut, p)) return side > 0;
  }
  // A hole all of whose vertices belong to the shell is that shell seen from the other side.
  if (all_on_shell) return false;
  return {};
}

// Gives each hole to the smallest piece around it. Returns false if a hole finds no piece, or if that is in doubt.
bool place_holes(const LocalCut& cut, std::vector<PieceRing>& holes, std::vector<PiecePlan>& plans) {
  std::vector<std::size_t> by_area(plans.size());
  std::iota(by_area.begin(), by_area.end(), std::size_t{0});
  std::ranges::sort(by_area, {}, [&](std::size_t i) { return plans[i].rings.front().area.area; });
  for (PieceRing& hole : holes) {
    bool is_placed = false;
    for (std::size_t k = 0; k < by_area.size() && !is_placed; ++k) {
      std::vector<PieceRing>& rings = plans[by_area[k]].rings;
      const std::optional<bool> inside = is_inside(cut, hole.points, rings.front().points);
      if (!inside) return false;
      is_placed = *inside;
      if (is_placed) rings.push_back(std::move(hole));
    }
    if (!is_placed) return false;
  }
  return true;
}

// Plans the loops of one walk: one outer ring and its touching holes, or only holes.
bool plan_walk(LocalCut& cut, const Walk& walk, std::vector<PiecePlan>& plans, std::vector<PieceRing>& free_holes) {
  PiecePlan plan{{}, walk.part};
  std::vector<PieceRing> holes;
  for (const Loop& loop : walk.loops) {
    PieceRing ring(write_loop(cut, loop), loop, -1);
    const int orientation = orientation_of(cut, ring);
    if (orientation == 0 || (orientation > 0 && !plan.rings.empty())) return false;
    (orientation > 0 ? plan.rings : holes).push_back(std::move(ring));
  }
  std::ranges::move(holes, std::back_inserter(plan.rings.empty() ? free_holes : plan.rings));
  if (!plan.rings.empty()) plans.push_back(std::move(plan));
  return true;
}

// Writes all rings and finds the piece that each bounds. Returns nullopt if that is in doubt.
std::optional<std::vector<PiecePlan>> plan_pieces(LocalCut& cut) {
  std::vector<PiecePlan> plans;
  std::vector<PieceRing> free_holes;  // holes whose shell is not known yet
  for (const Walk& walk : cut.graph.walks) {
    if (!plan_walk(cut, walk, plans, free_holes)) return {};
  }
  const auto add_shell = [&](const Ring& points, int shape_ring, Part part) {
    plans.push_back({{}, part});
    plans.back().rings.emplace_back(points, Loop{}, shape_ring);
  };
  if (cut.graph.walks.empty()) {  // the tool lies within the ice
    const Ring& tool = cut.tool.points;
    add_shell(tool, -1, Part::kInside);
    free_holes.emplace_back(Ring(tool.rbegin(), tool.rend()), Loop{}, -1);
  }
  for (int r = 0; r < cut.rings.count(); ++r) {
    if (cut.graph.ring_is_cut[r] != 0) continue;
    if (r == 0)
      add_shell(cut.rings[r], r, Part::kOutside);
    else
      free_holes.emplace_back(cut.rings[r], Loop{}, r);
  }
  if (free_holes.empty()) return plans;
  if (!place_holes(cut, free_holes, plans)) return {};
  return plans;
}

// Returns a piece before rounding.
exact::Polygon write_exactly(const LocalCut& cut, const PiecePlan& plan) {
  exact::Polygon polygon;
  for (const PieceRing& ring : plan.rings)
    (polygon.outer.empty() ? polygon.outer : polygon.holes.emplace_back()) = write_exactly(cut, ring);
  return polygon;
}

// Returns true if rounding the changed edges may have moved one of them across a whole ring of the piece.
bool may_have_swept_a_ring(const LocalCut& cut, const PiecePlan& plan) {
  if (plan.rings.size() < 2) return false;
  return std::any_of(plan.rings.begin(), plan.rings.end(), [&](const PieceRing& ring) {
    const Box box = bounding_box(ring.points);
    return std::any_of(cut.changed.begin(), cut.changed.end(),
                       [&](const Segment& s) { return contains(swept_box(s), box); });
  });
}

// ---- the check that rounding has broken nothing

enum class End { kNone, kExact, kRounded };

End end_at(const Segment& s, Point p) {
  if (p == s.from) return s.from_is_rounded ? End::kRounded : End::kExact;
  if (p == s.to) return s.to_is_rounded ? End::kRounded : End::kExact;
  return End::kNone;
}

// Returns true if two edges share at most an end, as edges of a subdivision do. A rounded node that has moved onto
// another vertex is not a shared end.
bool are_apart(const Segment& s, const Segment& t) {
  const SegmentMeeting meeting = meet(s.from, s.to, t.from, t.to);
  if (meeting.kind == Meeting::kNone) return true;
  const End end = end_at(s, meeting.at);
  return meeting.kind == Meeting::kTouch && end != End::kNone && end == end_at(t, meeting.at);
}

// Returns true if no two rounded nodes are in one point.
bool are_rounded_apart(const std::vector<Node>& nodes) {
  std::vector<Point> points;
  for (const Node& node : nodes) {
    if (node.is_active && node.is_rounded) points.push_back(node.at);
  }
  std::ranges::sort(points, geometry::precedes);
  return std::ranges::adjacent_find(points) == points.end();
}

// Returns true if a node splits the edge. Nodes are in order along the shape.
bool is_split(const LocalCut& cut, EdgeId e) {
  const auto key = [](const Place& p) { return std::tuple(p.ring, p.edge, !p.at_vertex); };
  const Place inside{e.ring, e.index, false};
  auto node = std::lower_bound(cut.nodes.begin(), cut.nodes.end(), inside,
                               [&](const Node& n, const Place& p) { return key(n.on_shape) < key(p); });
  for (; node != cut.nodes.end() && node->on_shape == inside; ++node) {
    if (node->is_active) return true;
  }
  return false;
}

// Returns true if every edge has a length and the edges touch each other only in shared ends.
bool are_apart(const std::vector<Segment>& changed) {
  const auto has_no_length = [](const Segment& s) { return s.from == s.to; };
  if (std::any_of(changed.begin(), changed.end(), has_no_length)) return false;
  return BoxTree(changed).for_each_pair(
      [&](std::size_t i, std::size_t j) { return are_apart(changed[i], changed[j]); });
}

// Returns true if the changed edges touch the other edges only in shared ends.
bool are_clear_of(const std::vector<Segment>& changed, const std::vector<Segment>& others) {
  const BoxTree tree(changed);
  return std::all_of(others.begin(), others.end(), [&](const Segment& t) {
    return tree.for_each_near(box_of(t), [&](std::size_t i) { return are_apart(changed[i], t); });
  });
}

// Only edges that end in a rounded node can have moved onto another edge. All others lie as in the exact subdivision,
// where edges touch only in nodes. Therefore only these edges are checked, against all edges near them.
bool changed_edges_are_apart(const LocalCut& cut, const Box& tool_box, const std::vector<EdgeId>& near_tool) {
  if (cut.changed.empty()) return true;
  if (!are_rounded_apart(cut.nodes) || !are_apart(cut.changed)) return false;
  if (!are_clear_of(cut.changed, cut.placed)) return false;
  Ring ends;
  for (const Segment& s : cut.changed) {
    ends.push_back(s.from);
    ends.push_back(s.to);
  }
  const Box box = bounding_box(ends);
  std::vector<Segment> others;
  for (const EdgeId e : contains(tool_box, box) ? near_tool : edges_near(cut.rings, box)) {
    if (!is_split(cut, e)) others.push_back({cut.rings.point(e.ring, e.index), cut.rings.point(e.ring, e.index + 1)});
  }
  return are_clear_of(cut.changed, others);
}

// ---- the cut

using exact::Rational;

// Returns true if two different rings of a valid polygon touch in a point. Exact.
bool has_touching_rings(const Polygon& polygon) {
  if (polygon.holes.empty()) return false;
  const std::vector<Edge> edges = edges_of(polygon);
  return !BoxTree(edges).for_each_pair([&](std::size_t i, std::size_t j) {
    const Edge& e = edges[i];
    const Edge& f = edges[j];
    return e.ring == f.ring || meet(e.a, e.b, f.a, f.b).kind == Meeting::kNone;
  });
}

// Returns twice the area between the straight edge that starts at `a` and the chain of points into which it was split,
// with the edge's own end last: zero if all points lie on it.
Rational twice_area_between(const exact::Point& a, const std::vector<exact::Point>& chain) {
  Rational sum = 0;
  for (std::size_t i = 1; i < chain.size(); ++i) {
    const exact::Point& p = chain[i - 1];
    const exact::Point& q = chain[i];
    sum += (p.x - a.x) * (q.y - a.y) - (p.y - a.y) * (q.x - a.x);
  }
  return sum;
}

// Checks Σ pieces − shape, in shoelace terms. Every chain of the shape is in the pieces once. Every chord is there once
// in each direction, so that its terms cancel. Untouched rings are carried over. The rest is each split edge against
// the parts into which it was split, summed here in rationals: before rounding it must be zero for every edge
// separately. Returns twice the area that rounding the nodes adds; nullopt if a sum is not zero.
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

// Returns the pieces as planned, if rounding has broken none of them.
CutResult take_as_planned(std::vector<PiecePlan> plans, double area_before, const Rational& rounding) {
  CutResult result;
  CutLedger& ledger = result.ledger;
  ledger.area_before = area_before;
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

// Returns the pieces rounded from their exact shapes, for cuts in which rounding has broken the planned ones.
CutOutcome round_exactly(const LocalCut& cut, const std::vector<PiecePlan>& plans, const Polygon& shape) {
  std::vector<exact::ExactPiece> pieces;
  pieces.reserve(plans.size());
  for (const PiecePlan& plan : plans) pieces.push_back({write_exactly(cut, plan), plan.part});
  return exact::rounded_pieces(exact::area(shape), pieces);
}

// Returns true if the written pieces contain every half-edge and every untouched ring of the shape exactly once.
bool uses_all_once(const LocalCut& cut, const std::vector<PiecePlan>& plans) {
  std::vector<int> uses(cut.graph.half_edges.size(), 0);
  std::vector<int> ring_uses(cut.graph.ring_is_cut.begin(), cut.graph.ring_is_cut.end());
  for (const PiecePlan& plan : plans) {
    for (const PieceRing& ring : plan.rings) {
      if (ring.shape_ring >= 0) ++ring_uses[ring.shape_ring];
      for (const int h : ring.loop) ++uses[h];
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

// Returns the length of the tool that separates nothing. An open tool that does not touch itself separates everywhere
// between its nodes, except for bridges; only those and the parts before the first and after the last node dangle.
double dangling_length(const LocalCut& cut, const Polygon& shape) {
  const int last_vertex = static_cast<int>(cut.tool.points.size()) - 1;
  if (cut.nodes.empty()) {
    return contains_strictly(shape, cut.tool.points.front()) ? length_along(cut.tool, 0, last_vertex) : 0;
  }
  double sum = 0;
  if (cut.graph.starts_inside) {
    const Node& node = cut.nodes[cut.graph.first_node];
    sum += length_along(cut.tool, 0, node.on_tool.edge) + distance(cut.tool.point(node.on_tool.edge), node.at);
  }
  if (cut.graph.ends_inside) {
    const Node& node = cut.nodes[cut.graph.last_node];
    const int next = node.on_tool.edge + 1;
    sum += distance(node.at, cut.tool.point(next)) + length_along(cut.tool, next, last_vertex);
  }
  for (const HalfEdge& bridge : cut.graph.bridges) {
    Point from = cut.nodes[bridge.from].at;
    for (int i = 0; i < bridge.run.count; ++i) {
      const Point to = cut.tool.point(bridge.run.first + i);
      sum += distance(from, to);
      from = to;
    }
    sum += distance(from, cut.nodes[bridge.to].at);
  }
  return sum;
}

// The cases without a chord: the tool runs beside the ice, ends in it, or one lies within the other.
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
  // If they touch, a vertex of the shape that is off the tool's boundary decides; without one, the general path is
  // used.
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
  result.ledger.exact_defect = "0";  // the one piece is the shape itself
  return result;
}

// Returns true if the planned pieces stay valid after rounding: no edge has moved onto another, no ring has been swept
// over, and every ring keeps its orientation. Otherwise the pieces are rounded from their exact shapes (round_exactly).
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

}  // namespace

std::optional<CutOutcome> cut_locally(const Polygon& shape, const Tool& tool) {
  const Rings rings(shape);
  const Box tool_box = bounding_box(tool.points);
  const std::vector<EdgeId> near_tool = edges_near(rings, tool_box);
  std::optional<std::vector<Node>> nodes = find_nodes(rings, tool, near_tool);
  if (!nodes) return {};  // rings touch each other at a node
  LocalCut cut{rings, tool, std::move(*nodes), {}, {}, {}};
  cut.graph = trace_faces(rings, tool, cut.nodes);
  // A chord between two rings makes one boundary of both. If they touched before, that boundary touches itself away
  // from all nodes. An inconsistent graph means that the shape or the tool was not valid.
  if (!cut.graph.is_consistent || (cut.graph.rings_met > 1 && has_touching_rings(shape))) return {};
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
