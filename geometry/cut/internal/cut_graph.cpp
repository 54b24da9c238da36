#include "geometry/cut/internal/cut_graph.hpp"

#include <algorithm>
#include <numeric>
#include <tuple>

#ifdef __SSE2__
#include <emmintrin.h>
#endif

namespace polynya::geometry {

// ---- nodes

namespace {

// The sides of the box beyond which a point lies. A segment between two points beyond one side does not touch the box.
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

// Returns a + t (b − a) with t = ((c − a) × (d − c)) / ((b − a) × (d − c)), in rationals.
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
    node.on_shape =
        place({e.ring, e.index, false}, n, at, rings_.point(e.ring, e.index), rings_.point(e.ring, e.index + 1));
    const int m = static_cast<int>(tool_.points.size());
    node.on_tool = place({0, tool_edge, false}, m, at, tool_.point(tool_edge), tool_.point(tool_edge + 1));
    nodes_.push_back(std::move(node));
  }

  /// Returns the place of a point on an edge from `from` to `to` of a ring of this size: at one of its ends or between.
  static Place place(const Place& on_edge, int size, Point at, Point from, Point to) {
    if (at == from) return {on_edge.ring, on_edge.edge, true};
    if (at == to) return {on_edge.ring, on_edge.edge + 1 == size ? 0 : on_edge.edge + 1, true};
    return on_edge;
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

// Returns true if p comes before q along the directed edge a→b on which both lie. Rounding keeps the order, so the
// rounded points decide if they differ.
bool comes_before(Point a, Point b, const Node& p, const Node& q) {
  const bool by_x = a.x != b.x;
  const Node& low = precedes(a, b) ? p : q;
  const Node& high = precedes(a, b) ? q : p;
  if (by_x && low.at.x != high.at.x) return low.at.x < high.at.x;
  if (!by_x && low.at.y != high.at.y) return low.at.y < high.at.y;
  return by_x ? exact_point(low).x < exact_point(high).x : exact_point(low).y < exact_point(high).y;
}

// The order of places along a ring; `ends` gives the end points of an edge.
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
      if (overlaps(box, tool_boxes[f])) collector.add(e, f);
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

// ---- faces

namespace {

// Returns the nodes' indices in their order along the tool.
std::vector<int> order_along_tool(const std::vector<Node>& nodes, const Tool& tool) {
  std::vector<int> order(nodes.size());
  std::iota(order.begin(), order.end(), 0);
  const auto ends = [&](const Place& p) { return std::pair(tool.point(p.edge), tool.point(p.edge + 1)); };
  std::sort(order.begin(), order.end(), [&](int i, int j) {
    const Node& p = nodes[i];
    const Node& q = nodes[j];
    return precedes(p.on_tool, p, q.on_tool, q, ends);
  });
  return order;
}

// The two directions in which a ring or polyline leaves a node.
struct Directions {
  Ray on;
  Ray back;
};

template <typename PointAt>
Directions directions_at(const Place& place, PointAt point) {
  if (place.at_vertex) {
    return {{point(place.edge), point(place.edge + 1)}, {point(place.edge), point(place.edge - 1)}};
  }
  return {{point(place.edge), point(place.edge + 1)}, {point(place.edge + 1), point(place.edge)}};
}

bool same_direction(const Ray& u, const Ray& v) {
  return cross_sign(u, v) == 0 && dot_sign(u.tail, u.head, v.tail, v.head) > 0;
}

// Returns the vertices strictly after `from` and before `to`; `wraps` is true if the run passes the ring's first
// vertex.
Run run_between(const Place& from, const Place& to, bool wraps, int size) {
  const int first = from.edge + 1;
  const int last = to.at_vertex ? to.edge - 1 : to.edge;
  const int count = last - first + 1 + (wraps ? size : 0);
  return {first == size ? 0 : first, count};
}

class Faces {
 public:
  Faces(const Rings& rings, const Tool& tool, std::vector<Node>& nodes) : rings_(rings), tool_(tool), nodes_(nodes) {}

  CutGraph trace() {
    find_chords();
    build();
    graph_.rings_met = static_cast<int>(std::count(graph_.ring_is_cut.begin(), graph_.ring_is_cut.end(), 1));
    if (!tool_.is_closed && graph_.rings_met > 1 && drop_bridges()) build();
    const auto is_possible = [](const HalfEdge& e) { return e.run.count >= 0; };
    graph_.is_consistent =
        graph_.is_consistent && std::all_of(graph_.half_edges.begin(), graph_.half_edges.end(), is_possible);
    return std::move(graph_);
  }

 private:
  struct Chord {
    int from;
    int to;
    Run run;
  };

  Node& node(int i) { return nodes_[i]; }
  Directions shape_at(int n) {
    const Place& place = node(n).on_shape;
    return directions_at(place, [&](int i) { return rings_.point(place.ring, i); });
  }
  Directions tool_at(int n) {
    return directions_at(node(n).on_tool, [&](int i) { return tool_.point(i); });
  }

  // Returns true if the ray leads from the node into the shape's interior, and not along the boundary.
  bool leads_inside(int n, const Ray& ray) {
    const Directions shape = shape_at(n);
    if (same_direction(ray, shape.on) || same_direction(ray, shape.back)) return false;
    return met_before(shape.on, ray, shape.back);
  }

  void build() {
    graph_.half_edges.clear();
    graph_.walks.clear();
    add_shape_chains();
    add_chord_half_edges();
    link();
    walk();
  }

  // A chord with one face on both sides joins two rings and separates nothing. Removing all of them does not change the
  // faces. (In a face's boundary both sides of such a chord are in one walk.)
  bool drop_bridges() {
    std::vector<int> walk_of(graph_.half_edges.size(), -1);
    for (std::size_t w = 0; w < graph_.walks.size(); ++w) {
      for (const Loop& loop : graph_.walks[w].loops) {
        for (const int h : loop) walk_of[h] = static_cast<int>(w);
      }
    }
    std::vector<Chord> kept;
    for (std::size_t c = 0; c < chords_.size(); ++c) {
      const std::size_t forward = first_chord_ + 2 * c;
      if (walk_of[forward] == walk_of[forward + 1]) {
        graph_.bridges.push_back(graph_.half_edges[forward]);
      } else {
        kept.push_back(chords_[c]);
      }
    }
    for (Node& n : nodes_) n.is_active = false;
    for (const Chord& chord : kept) node(chord.from).is_active = node(chord.to).is_active = true;
    chords_ = std::move(kept);
    return !graph_.bridges.empty();
  }

  void find_chords() {
    const std::vector<int> order = order_along_tool(nodes_, tool_);
    if (order.empty()) return;
    graph_.first_node = order.front();
    graph_.last_node = order.back();
    const int size = static_cast<int>(tool_.points.size());
    if (!tool_.is_closed) {
      const Place& first = node(order.front()).on_tool;
      const Place& last = node(order.back()).on_tool;
      const bool is_start = first.at_vertex && first.edge == 0;
      const bool is_end = last.at_vertex && last.edge + 1 == size;
      graph_.starts_inside = !is_start && leads_inside(order.front(), tool_at(order.front()).back);
      graph_.ends_inside = !is_end && leads_inside(order.back(), tool_at(order.back()).on);
    }
    for (std::size_t i = 0; i < order.size(); ++i) {
      const bool is_last = i + 1 == order.size();
      if (is_last && !tool_.is_closed) return;
      const int from = order[i];
      const int to = order[is_last ? 0 : i + 1];
      if (!leads_inside(from, tool_at(from).on)) continue;
      chords_.push_back({from, to, run_between(node(from).on_tool, node(to).on_tool, is_last, size)});
      node(from).is_active = true;
      node(to).is_active = true;
    }
  }

  void add_shape_chains() {
    graph_.ring_is_cut.assign(static_cast<std::size_t>(rings_.count()), 0);
    const int count = static_cast<int>(nodes_.size());
    for (int begin = 0; begin < count;) {
      const int ring = node(begin).on_shape.ring;
      int end = begin;
      std::vector<int> active;
      for (; end < count && node(end).on_shape.ring == ring; ++end) {
        if (node(end).is_active) active.push_back(end);
      }
      begin = end;
      if (active.empty()) continue;
      graph_.ring_is_cut[ring] = 1;
      const int size = static_cast<int>(rings_[ring].size());
      for (std::size_t i = 0; i < active.size(); ++i) {
        const bool wraps = i + 1 == active.size();
        const int from = active[i];
        const int to = active[wraps ? 0 : i + 1];
        const Run run = run_between(node(from).on_shape, node(to).on_shape, wraps, size);
        graph_.half_edges.push_back({from, to, false, true, ring, run});
      }
    }
  }

  void add_chord_half_edges() {
    first_chord_ = graph_.half_edges.size();
    for (const Chord& chord : chords_) {
      graph_.half_edges.push_back({chord.from, chord.to, true, true, 0, chord.run});
      graph_.half_edges.push_back({chord.to, chord.from, true, false, 0, chord.run});
    }
  }

  // The direction of a half-edge at its first node, and the one back along it at its last node.
  Ray leaving(const HalfEdge& e) {
    if (!e.is_chord) return shape_at(e.from).on;
    return e.is_forward ? tool_at(e.from).on : tool_at(e.from).back;
  }
  Ray arriving(const HalfEdge& e) {
    if (!e.is_chord) return shape_at(e.to).back;
    return e.is_forward ? tool_at(e.to).back : tool_at(e.to).on;
  }

  // The face on the left of an arriving half-edge lies clockwise of it. Its boundary continues along the first
  // half-edge in clockwise direction, which is the last one counter-clockwise.
  void link() {
    const int count = static_cast<int>(graph_.half_edges.size());
    std::vector<std::vector<int>> leaving_node(nodes_.size());
    for (int h = 0; h < count; ++h) {
      leaving_node[static_cast<std::size_t>(half_edge(h).from)].push_back(h);
    }
    next_.resize(static_cast<std::size_t>(count));
    for (int h = 0; h < count; ++h) {
      const Ray back = arriving(half_edge(h));
      const std::vector<int>& out = leaving_node[static_cast<std::size_t>(half_edge(h).to)];
      int best = out.front();
      for (const int candidate : out) {
        if (met_before(back, leaving(half_edge(best)), leaving(half_edge(candidate)))) best = candidate;
      }
      next_[h] = best;
    }
  }

  // A walk that returns to a node that it has left before closes a loop there.
  void walk() {
    const std::size_t count = graph_.half_edges.size();
    constexpr int kNowhere = -1;
    std::vector<char> visited(count, 0);
    std::vector<int> place(nodes_.size(), kNowhere);  // place in `open` of the half-edge that leaves the node
    for (int start = 0; start < static_cast<int>(count); ++start) {
      if (visited[start] != 0) continue;
      Walk walk;
      Loop open;  // the chain so far, without its loops
      for (int h = start; visited[h] == 0; h = next_[h]) {
        visited[h] = 1;
        const HalfEdge& e = half_edge(h);
        if (e.is_chord && e.is_forward && tool_.is_closed) walk.part = Part::kInside;
        place[e.from] = static_cast<int>(open.size());
        open.push_back(h);
        const int loop = place[e.to];
        if (loop == kNowhere) continue;
        walk.loops.emplace_back(open.begin() + loop, open.end());
        for (auto g = open.begin() + loop; g != open.end(); ++g) {
          place[static_cast<std::size_t>(half_edge(*g).from)] = kNowhere;
        }
        open.resize(static_cast<std::size_t>(loop));
      }
      if (!open.empty()) graph_.is_consistent = false;
      for (const int h : open) place[static_cast<std::size_t>(half_edge(h).from)] = kNowhere;
      graph_.walks.push_back(std::move(walk));
    }
  }

  const HalfEdge& half_edge(int h) const { return graph_.half_edges[h]; }

  const Rings& rings_;
  const Tool& tool_;
  std::vector<Node>& nodes_;
  CutGraph graph_;
  std::vector<Chord> chords_;
  std::vector<int> next_;
  std::size_t first_chord_ = 0;
};

}  // namespace

CutGraph trace_faces(const Rings& rings, const Tool& tool, std::vector<Node>& nodes) {
  return Faces(rings, tool, nodes).trace();
}

}  // namespace polynya::geometry
