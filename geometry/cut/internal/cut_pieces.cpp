#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "geometry/cut/internal/local_cut.hpp"
#include "geometry/exact/internal/predicates.hpp"
#include "geometry/exact/point_in_ring.hpp"

namespace polynya::geometry {
namespace {

using Source = PieceRing::Source;

// Calls on_node(node, half-edge) and on_run(first, last, half-edge) for a loop's vertices in order; the
// half-edge is the one along which the loop leaves them, [first, last) are iterators over points.
template <typename OnNode, typename OnRun>
void for_each_stretch(const LocalCut& cut, const Loop& loop, OnNode on_node, OnRun on_run) {
  for (const int h : loop) {
    const HalfEdge& e = cut.graph.half_edges[static_cast<std::size_t>(h)];
    on_node(cut.nodes[static_cast<std::size_t>(e.from)], e);
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

std::size_t vertex_count(const LocalCut& cut, const Loop& loop) {
  std::size_t count = loop.size();
  for (const int h : loop) {
    count += static_cast<std::size_t>(cut.graph.half_edges[static_cast<std::size_t>(h)].run.count);
  }
  return count;
}

// Writes a loop's vertices, noting on the way the edges that are new; those of a chord once, on its forward
// side.
Ring write_loop(LocalCut& cut, const Loop& loop) {
  struct Vertex {
    bool is_node = false;
    bool is_rounded = false;
    const HalfEdge* leaves_along;
  };
  Ring points;
  points.reserve(vertex_count(cut, loop));
  const HalfEdge& start = cut.graph.half_edges[static_cast<std::size_t>(loop.front())];
  Vertex first{true, false, &start};
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

void write(LocalCut& cut, PieceRing& ring) {
  switch (ring.source) {
    case Source::kLoop:
      ring.points = write_loop(cut, ring.loop);
      break;
    case Source::kShapeRing:
      ring.points = cut.rings[ring.shape_ring];
      break;
    case Source::kTool:
      ring.points = cut.tool.points;
      break;
    case Source::kToolReversed:
      ring.points = {cut.tool.points.rbegin(), cut.tool.points.rend()};
  }
  ring.area = ring_area(ring.points);
}

exact::Ring write_exactly(const LocalCut& cut, const PieceRing& ring) {
  if (ring.source != Source::kLoop) return exact::exactly(ring.points);
  exact::Ring points;
  for_each_stretch(
      cut, ring.loop, [&](const Node& node, const HalfEdge&) { points.push_back(exact_point(node)); },
      [&](auto from, auto to, const HalfEdge&) {
        for (; from != to; ++from) points.push_back(exact::exactly(*from));
      });
  return points;
}

// Which way the exact loop turns: as the rounded one wherever its area is clear of all errors.
int turn_of(const LocalCut& cut, const PieceRing& ring) {
  const double clear = ring.area.doubt + 2 * ring.area.step_area;
  if (ring.area.area > clear) return 1;
  if (-ring.area.area > clear) return -1;
  return sgn(exact::area(write_exactly(cut, ring)));
}

// More than rounding can have moved the ends of the edge.
double reach(const Segment& s) {
  const double size = std::max({std::abs(s.from.x), std::abs(s.from.y), std::abs(s.to.x), std::abs(s.to.y)});
  return 4 * (std::nextafter(size, std::numeric_limits<double>::infinity()) - size);
}

// A box that holds the edge before and after its ends were rounded.
Box swept_box(const Segment& s) {
  return grown(box_around(s.from, s.to), reach(s));
}

// Finds the shell of a hole by a vertex far from all changed edges: the rounded and the exact rings agree
// there.
class Placer {
 public:
  Placer(const LocalCut& cut, std::vector<PiecePlan>& plans) : plans_(plans), changed_(cut.changed) {
    for (std::size_t i = 0; i < plans.size(); ++i) by_area_.push_back(i);
    const auto area = [&](std::size_t i) { return plans[i].rings.front().area.area; };
    std::ranges::sort(by_area_, {}, area);
  }

  bool place(PieceRing hole) {
    for (const std::size_t i : by_area_) {
      const std::optional<bool> inside = is_inside(hole.points, plans_[i].rings.front().points);
      if (!inside) return false;
      if (!*inside) continue;
      plans_[i].rings.push_back(std::move(hole));
      return true;
    }
    return false;
  }

 private:
  std::optional<bool> is_inside(const Ring& hole, const Ring& shell) const {
    bool all_on_shell = true;
    for (const Point p : hole) {
      const int side = side_of_ring(shell, p);
      all_on_shell = all_on_shell && side == 0;
      if (side != 0 && !is_doubtful(p)) return side > 0;
    }
    // A hole all of whose vertices are the shell's is that shell seen from the other side.
    if (all_on_shell) return false;
    return {};
  }

  // Within reach of an edge of the shell whose ends were rounded? (An edge that ends in p itself is not the
  // shell's: p is off it.) The threshold is well above the errors of the product.
  bool is_doubtful(Point p) const {
    return std::any_of(changed_.begin(), changed_.end(), [&](const Segment& s) {
      if (p == s.from || p == s.to || !overlaps(swept_box(s), {p, p})) return false;
      const Vector along = s.to - s.from;
      return std::abs(cross(along, p - s.from)) <= 8 * reach(s) * (std::abs(along.x) + std::abs(along.y) + reach(s));
    });
  }

  std::vector<PiecePlan>& plans_;
  std::vector<std::size_t> by_area_;
  const std::vector<Segment>& changed_;
};

// The loops of one walk: one outer ring and its touching holes, or holes only.
bool plan_walk(LocalCut& cut, const Walk& walk, std::vector<PiecePlan>& plans, std::vector<PieceRing>& free_holes) {
  PiecePlan plan{{}, walk.part};
  std::vector<PieceRing> holes;
  for (const Loop& loop : walk.loops) {
    PieceRing ring{Source::kLoop, loop, 0, {}, {}};
    write(cut, ring);
    const int turn = turn_of(cut, ring);
    if (turn == 0 || (turn > 0 && !plan.rings.empty())) return false;
    (turn > 0 ? plan.rings : holes).push_back(std::move(ring));
  }
  std::ranges::move(holes, std::back_inserter(plan.rings.empty() ? free_holes : plan.rings));
  if (!plan.rings.empty()) plans.push_back(std::move(plan));
  return true;
}

}  // namespace

std::optional<std::vector<PiecePlan>> plan_pieces(LocalCut& cut) {
  std::vector<PiecePlan> plans;
  std::vector<PieceRing> free_holes;  // holes whose shell is not known yet
  for (const Walk& walk : cut.graph.walks) {
    if (!plan_walk(cut, walk, plans, free_holes)) return {};
  }
  const auto whole = [&](Source source, int shape_ring) {
    PieceRing ring{source, {}, shape_ring, {}, {}};
    write(cut, ring);
    return ring;
  };
  const auto add_shell = [&](PieceRing ring, Part part) {
    plans.push_back({{}, part});
    plans.back().rings.push_back(std::move(ring));
  };
  if (cut.graph.walks.empty()) {  // the tool lies within the ice
    add_shell(whole(Source::kTool, 0), Part::kInside);
    free_holes.push_back(whole(Source::kToolReversed, 0));
  }
  for (int r = 0; r < cut.rings.count(); ++r) {
    if (cut.graph.ring_is_cut[static_cast<std::size_t>(r)] != 0) continue;
    PieceRing ring = whole(Source::kShapeRing, r);
    if (r == 0) {
      add_shell(std::move(ring), Part::kOutside);
    } else {
      free_holes.push_back(std::move(ring));
    }
  }
  if (free_holes.empty()) return plans;
  Placer placer(cut, plans);
  for (PieceRing& hole : free_holes) {
    if (!placer.place(std::move(hole))) return {};
  }
  return plans;
}

exact::Polygon write_exactly(const LocalCut& cut, const PiecePlan& plan) {
  exact::Polygon polygon;
  for (const PieceRing& ring : plan.rings)
    (polygon.outer.empty() ? polygon.outer : polygon.holes.emplace_back()) = write_exactly(cut, ring);
  return polygon;
}

bool may_have_swept_a_ring(const LocalCut& cut, const PiecePlan& plan) {
  if (plan.rings.size() < 2) return false;
  return std::any_of(plan.rings.begin(), plan.rings.end(), [&](const PieceRing& ring) {
    const Box box = bounding_box(ring.points);
    return std::any_of(cut.changed.begin(), cut.changed.end(),
                       [&](const Segment& s) { return contains(swept_box(s), box); });
  });
}

}  // namespace polynya::geometry
