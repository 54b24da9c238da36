#include <algorithm>

#include "geometry/cut/internal/local_cut.hpp"

namespace polynya::geometry {
namespace {

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

// Vertices strictly after `from` and strictly before `to`; `wraps` where the run passes the ring's first
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

  Node& node(int i) { return nodes_[static_cast<std::size_t>(i)]; }
  Directions shape_at(int n) {
    const Place& place = node(n).on_shape;
    return directions_at(place, [&](int i) { return rings_.point(place.ring, i); });
  }
  Directions tool_at(int n) {
    return directions_at(node(n).on_tool, [&](int i) { return tool_.point(i); });
  }

  // Does the ray lead from the node into the shape's interior? (Not where it runs along the boundary.)
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

  // A chord with one face on both sides joins two rings and separates nothing. Taking all of them away leaves
  // the faces as they are. (In a face's boundary, both sides of such a chord are in one walk.)
  bool drop_bridges() {
    std::vector<int> walk_of(graph_.half_edges.size(), -1);
    for (std::size_t w = 0; w < graph_.walks.size(); ++w) {
      for (const Loop& loop : graph_.walks[w].loops) {
        for (const int h : loop) walk_of[static_cast<std::size_t>(h)] = static_cast<int>(w);
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
      graph_.ring_is_cut[static_cast<std::size_t>(ring)] = 1;
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

  // The directions of a half-edge at its first node, and back along it at its last.
  Ray leaving(const HalfEdge& e) {
    if (!e.is_chord) return shape_at(e.from).on;
    return e.is_forward ? tool_at(e.from).on : tool_at(e.from).back;
  }
  Ray arriving(const HalfEdge& e) {
    if (!e.is_chord) return shape_at(e.to).back;
    return e.is_forward ? tool_at(e.to).back : tool_at(e.to).on;
  }

  // The face on the left of an arriving half-edge lies clockwise of it: its boundary continues along the
  // first half-edge met clockwise, which is the last one met counter-clockwise.
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
      next_[static_cast<std::size_t>(h)] = best;
    }
  }

  // A walk that comes back to a node it has left before closes a loop there.
  void walk() {
    const std::size_t count = graph_.half_edges.size();
    constexpr int kNowhere = -1;
    std::vector<char> visited(count, 0);
    std::vector<int> place(nodes_.size(), kNowhere);  // in `open`, of the half-edge that leaves the node
    for (int start = 0; start < static_cast<int>(count); ++start) {
      if (visited[static_cast<std::size_t>(start)] != 0) continue;
      Walk walk;
      Loop open;  // the chain so far, its loops taken off
      for (int h = start; visited[static_cast<std::size_t>(h)] == 0; h = next_[static_cast<std::size_t>(h)]) {
        visited[static_cast<std::size_t>(h)] = 1;
        const HalfEdge& e = half_edge(h);
        if (e.is_chord && e.is_forward && tool_.is_closed) walk.part = Part::kInside;
        place[static_cast<std::size_t>(e.from)] = static_cast<int>(open.size());
        open.push_back(h);
        const int loop = place[static_cast<std::size_t>(e.to)];
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

  const HalfEdge& half_edge(int h) const { return graph_.half_edges[static_cast<std::size_t>(h)]; }

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
