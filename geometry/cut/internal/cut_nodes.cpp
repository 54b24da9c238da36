#include <algorithm>
#include <numeric>
#include <tuple>

#include "geometry/cut/internal/local_cut.hpp"
#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace polynya::geometry {
namespace {

// Which of the box's four sides a point is beyond. Two points beyond one side have nothing of the box between
// them.
#ifdef __SSE2__
class Sides {
 public:
  explicit Sides(const Box& box) : low_(_mm_loadu_pd(&box.low.x)), high_(_mm_loadu_pd(&box.high.x)) {}
  int beyond(const Point& p) const {
    const __m128d at = _mm_loadu_pd(&p.x);
    return _mm_movemask_pd(_mm_cmplt_pd(at, low_)) | _mm_movemask_pd(_mm_cmpgt_pd(at, high_)) << 2;
  }

 private:
  __m128d low_;
  __m128d high_;
};
#else
class Sides {
 public:
  explicit Sides(const Box& box) : box_(box) {}
  int beyond(const Point& p) const {
    return static_cast<int>(p.x < box_.low.x) | static_cast<int>(p.y < box_.low.y) << 1 |
           static_cast<int>(p.x > box_.high.x) << 2 | static_cast<int>(p.y > box_.high.y) << 3;
  }

 private:
  Box box_;
};
#endif

// a + t (b − a) with t = ((c − a) × (d − c)) / ((b − a) × (d − c)), in rationals.
exact::Point crossing_point(Point a, Point b, Point c, Point d) {
  using exact::Rational;
  const Rational ax(a.x);
  const Rational ay(a.y);
  const Rational ux = Rational(b.x) - ax;
  const Rational uy = Rational(b.y) - ay;
  const Rational vx = Rational(d.x) - Rational(c.x);
  const Rational vy = Rational(d.y) - Rational(c.y);
  const Rational t = ((Rational(c.x) - ax) * vy - (Rational(c.y) - ay) * vx) / (ux * vy - uy * vx);
  return {ax + t * ux, ay + t * uy};
}

class Collector {
 public:
  Collector(const Rings& rings, const Tool& tool) : rings_(rings), tool_(tool) {}

  void add(EdgeId e, int tool_edge) {
    const Point a = rings_.point(e.ring, e.index);
    const Point b = rings_.point(e.ring, e.index + 1);
    const Point c = tool_.point(tool_edge);
    const Point d = tool_.point(tool_edge + 1);
    const SegmentMeeting meeting = meet(a, b, c, d);
    switch (meeting.kind) {
      case Meeting::kNone:
        return;
      case Meeting::kTouch:
        return add_touch(e, tool_edge, meeting.at);
      case Meeting::kCross:
        return add_crossing(e, tool_edge);
      case Meeting::kOverlap:
        for (const Point end : {a, b}) {
          if (in_span(c, d, end)) add_touch(e, tool_edge, end);
        }
        for (const Point end : {c, d}) {
          if (in_span(a, b, end)) add_touch(e, tool_edge, end);
        }
    }
  }

  std::optional<std::vector<Node>> nodes() {
    const auto key = [](const Node& n) { return std::tie(n.at.x, n.at.y, n.is_rounded); };
    std::sort(nodes_.begin(), nodes_.end(), [&](const Node& a, const Node& b) { return key(a) < key(b); });
    std::vector<Node> unique;
    for (Node& node : nodes_) {
      if (unique.empty() || node.is_rounded || key(unique.back()) != key(node)) {
        unique.push_back(std::move(node));
      } else if (!(unique.back().on_shape == node.on_shape && unique.back().on_tool == node.on_tool)) {
        return {};
      }
    }
    return unique;
  }

 private:
  void add_touch(EdgeId e, int tool_edge, Point at) {
    Node node;
    node.at = at;
    const int n = static_cast<int>(rings_[e.ring].size());
    node.on_shape = place(e.ring, e.index, n, at, rings_.point(e.ring, e.index), rings_.point(e.ring, e.index + 1));
    const int m = static_cast<int>(tool_.points.size());
    node.on_tool = place(0, tool_edge, m, at, tool_.point(tool_edge), tool_.point(tool_edge + 1));
    nodes_.push_back(std::move(node));
  }

  static Place place(int ring, int edge, int size, Point at, Point from, Point to) {
    if (at == from) return {ring, edge, true};
    if (at == to) return {ring, edge + 1 == size ? 0 : edge + 1, true};
    return {ring, edge, false};
  }

  void add_crossing(EdgeId e, int tool_edge) {
    Node node;
    node.exactly_at = crossing_point(rings_.point(e.ring, e.index), rings_.point(e.ring, e.index + 1),
                                     tool_.point(tool_edge), tool_.point(tool_edge + 1));
    node.at = exact::rounded(node.exactly_at);
    node.is_rounded = !(exact::exactly(node.at) == node.exactly_at);
    node.on_shape = {e.ring, e.index, false};
    node.on_tool = {0, tool_edge, false};
    nodes_.push_back(std::move(node));
  }

  const Rings& rings_;
  const Tool& tool_;
  std::vector<Node> nodes_;
};

// Does p come before q along the directed edge a→b, on which both lie? Rounding keeps order, so the rounded
// points decide wherever they differ.
bool comes_before(Point a, Point b, const Node& p, const Node& q) {
  const bool by_x = a.x != b.x;
  const Node& low = precedes(a, b) ? p : q;
  const Node& high = precedes(a, b) ? q : p;
  if (by_x && low.at.x != high.at.x) return low.at.x < high.at.x;
  if (!by_x && low.at.y != high.at.y) return low.at.y < high.at.y;
  return by_x ? exact_point(low).x < exact_point(high).x : exact_point(low).y < exact_point(high).y;
}

// Order of places along a ring; `from` and `to` give the ends of an edge.
template <typename EndsOfEdge>
bool precedes(const Place& p, const Node& node_p, const Place& q, const Node& node_q, EndsOfEdge ends) {
  if (p.ring != q.ring) return p.ring < q.ring;
  if (p.edge != q.edge) return p.edge < q.edge;
  if (p.at_vertex != q.at_vertex) return p.at_vertex;
  if (p.at_vertex) return false;
  const auto [a, b] = ends(p);
  return comes_before(a, b, node_p, node_q);
}

}  // namespace

exact::Point exact_point(const Node& node) {
  return node.is_rounded ? node.exactly_at : exact::exactly(node.at);
}

std::vector<EdgeId> edges_near(const Rings& rings, const Box& box) {
  std::vector<EdgeId> near;
  const Sides sides(box);
  for (int r = 0; r < rings.count(); ++r) {
    const Ring& ring = rings[r];
    const std::size_t n = ring.size();
    int previous = sides.beyond(ring[0]);
    const int first = previous;
    for (std::size_t i = 1; i < n; ++i) {
      const int current = sides.beyond(ring[i]);
      if ((previous & current) == 0) near.push_back({r, static_cast<int>(i) - 1});
      previous = current;
    }
    if ((previous & first) == 0) near.push_back({r, static_cast<int>(n) - 1});
  }
  return near;
}

std::optional<std::vector<Node>> find_nodes(const Rings& rings, const Tool& tool, const std::vector<EdgeId>& near) {
  std::vector<Box> tool_boxes;
  const int tool_edges = tool.edge_count();
  tool_boxes.reserve(static_cast<std::size_t>(tool_edges));
  for (int f = 0; f < tool_edges; ++f) tool_boxes.push_back(box_around(tool.point(f), tool.point(f + 1)));
  Collector collector(rings, tool);
  for (const EdgeId e : near) {
    const Box box = box_around(rings.point(e.ring, e.index), rings.point(e.ring, e.index + 1));
    for (int f = 0; f < tool_edges; ++f) {
      if (overlaps(box, tool_boxes[static_cast<std::size_t>(f)])) collector.add(e, f);
    }
  }
  std::optional<std::vector<Node>> nodes = collector.nodes();
  if (!nodes) return {};
  const auto ends = [&](const Place& p) {
    return std::pair(rings.point(p.ring, p.edge), rings.point(p.ring, p.edge + 1));
  };
  std::sort(nodes->begin(), nodes->end(),
            [&](const Node& p, const Node& q) { return precedes(p.on_shape, p, q.on_shape, q, ends); });
  return nodes;
}

std::vector<int> order_along_tool(const std::vector<Node>& nodes, const Tool& tool) {
  std::vector<int> order(nodes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = [&](const Place& p) { return std::pair(tool.point(p.edge), tool.point(p.edge + 1)); };
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const Node& p = nodes[static_cast<std::size_t>(i)];
    const Node& q = nodes[static_cast<std::size_t>(j)];
    return precedes(p.on_tool, p, q.on_tool, q, ends);
  });
  return order;
}

}  // namespace polynya::geometry
