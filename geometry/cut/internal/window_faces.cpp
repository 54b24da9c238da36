#include "geometry/cut/internal/window_faces.hpp"

#include <algorithm>
#include <numeric>
#include <set>
#include <unordered_map>

namespace polynya::geometry {
namespace {

using exact::PlaneGraph;
using exact::Seams;
using exact::SourceSegment;
using exact::Winding;

std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

bool precedes(const exact::Point& a, const exact::Point& b) {
  return a.x != b.x ? a.x < b.x : a.y < b.y;
}

// Strictly inside a valid polygon on whose boundary the point is not? Nearest doubles decide wherever they
// can.
bool is_inside(const Rings& shape, const exact::Point& p) {
  const Point near_p = exact::rounded(p);
  bool inside = false;
  for (int r = 0; r < shape.count(); ++r) {
    const Ring& ring = shape[r];
    for (int i = 0; i < static_cast<int>(ring.size()); ++i) {
      const Point near_a = ring[at(i)];
      const Point near_b = shape.point(r, i + 1);
      if ((near_a.y > near_p.y && near_b.y > near_p.y) || (near_a.y < near_p.y && near_b.y < near_p.y))
        continue;
      if (near_a.x > near_p.x && near_b.x > near_p.x) continue;
      const exact::Point a = shape.exact_point(r, i);
      const exact::Point b = shape.exact_point(r, i + 1);
      if ((a.y > p.y) == (b.y > p.y)) continue;
      const bool is_left = (orientation(a, b, p) > 0) == (a.y > b.y);
      if (is_left) inside = !inside;
    }
  }
  return inside;
}

// The graph of the window with each far chain as one more edge that joins two of its loose ends: then faces
// are walked as if the whole shape had been arranged.
class Faces {
 public:
  Faces(const Rings& shape, const Window& window, const std::vector<SourceSegment>& segments,
        const std::vector<SourceSegment>& tool, bool tool_winds)
      : shape_(shape),
        window_(window),
        segments_(segments),
        tool_(tool),
        tool_winds_(tool_winds),
        graph_(exact::plane_graph(segments)),
        arranged_(graph_.half_edge_count()) {}

  bool build(const exact::Classifier& classify, Seams seams) {
    seams_ = seams;
    if (!link_chains()) return false;
    find_loops();
    wind_components();
    if (!windings_agree()) return false;
    for (const Winding& w : winding_) label_.push_back(classify(w));
    join_loops();
    return true;
  }

  std::vector<RegionBoundary> boundaries() {
    std::vector<RegionBoundary> result;
    std::unordered_map<int, std::size_t> of_class;
    std::vector<char> visited(graph_.origin.size(), 0);
    for (int h = 0; h < graph_.half_edge_count(); ++h) {
      const int loop = loop_[at(h)];
      if (visited[at(h)] != 0 || label_[at(loop)] < 0 || !is_boundary(h)) continue;
      const auto [found, is_new] = of_class.try_emplace(root_of(loop), result.size());
      if (is_new) result.push_back({{}, label_[at(loop)], component_[at(loop)]});
      trace(h, visited, result[found->second].rings);
    }
    return result;
  }

  void find_tool_inside(WindowOverlay& result) const {
    for (int h = 0; h < arranged_; h += 2) {
      const int left = loop_[at(h)];
      const int right = loop_[at(h + 1)];
      if (winding_[at(left)].shape == 0 || winding_[at(right)].shape == 0 || first_source(h) == 0) continue;
      result.tool_meets_interior = true;
      if (left != right) continue;
      result.dangling_length += distance(exact::rounded(graph_.points[at(graph_.origin[at(h)])]),
                                         exact::rounded(graph_.points[at(graph_.target(h))]));
    }
  }

  int component_count() const { return static_cast<int>(lowest_.size()); }
  PlaneGraph take_graph() { return std::move(graph_); }

 private:
  bool is_chain(int h) const { return h >= arranged_; }

  // Ends of far chains lie on nothing else: there the window's own edge turns back on itself, and that is
  // where the chain goes on.
  bool link_chains() {
    std::vector<int> into(window_.chains.size(), -1);    // the half-edge that ends where the chain starts
    std::vector<int> out_of(window_.chains.size(), -1);  // the one that starts where it ends
    for (int h = 0; h < arranged_; ++h) {
      for (const std::size_t s : graph_.sources[at(h / 2)]) {
        if (s >= window_.near.size() || !runs_along(s, h)) continue;
        const int after = window_.chain_after[s];
        if (after >= 0 && graph_.points[at(graph_.target(h))] == segments_[s].to) into[at(after)] = h;
        const int before = window_.chain_before[s];
        if (before >= 0 && graph_.points[at(graph_.origin[at(h)])] == segments_[s].from)
          out_of[at(before)] = h;
      }
    }
    for (std::size_t c = 0; c < into.size(); ++c) {
      const int in = into[c];
      const int out = out_of[c];
      if (in < 0 || out < 0 || graph_.next[at(in)] != (in ^ 1) || graph_.next[at(out ^ 1)] != out)
        return false;
      const int forward = graph_.half_edge_count();
      const int start = graph_.target(in);
      const int end = graph_.origin[at(out)];
      graph_.origin.insert(graph_.origin.end(), {start, end});
      graph_.next.insert(graph_.next.end(), {out, in ^ 1});
      graph_.next[at(in)] = forward;
      graph_.next[at(out ^ 1)] = forward + 1;
    }
    return is_permutation();
  }

  // Is every half-edge the next of just one? All walks below come back to their start because of it. A shape
  // that was said to be valid and is not may link one loose end twice.
  bool is_permutation() const {
    std::vector<char> follows(graph_.next.size(), 0);
    for (const int next : graph_.next) follows[at(next)] = 1;
    return std::all_of(follows.begin(), follows.end(), [](char is_next) { return is_next != 0; });
  }

  bool runs_along(std::size_t s, int h) const {
    return exact::runs_rightward(segments_[s]) == (graph_.is_rightward[at(h)] != 0);
  }

  // What crossing from right to left adds to the winding.
  Winding step_over(int h) const {
    if (is_chain(h)) return {(h & 1) == 0 ? 1 : -1, 0};
    Winding step;
    for (const std::size_t s : graph_.sources[at(h / 2)]) {
      const int sign = runs_along(s, h) ? 1 : -1;
      if (segments_[s].source == 0) {
        step.shape += sign;
      } else if (tool_winds_) {
        step.tool += sign;
      }
    }
    return step;
  }

  // Loops of half-edges; those that edges join are one component, whose windings are first told from an
  // arbitrary zero.
  void find_loops() {
    loop_.assign(graph_.origin.size(), -1);
    for (int start = 0; start < graph_.half_edge_count(); ++start) {
      if (loop_[at(start)] >= 0) continue;
      const int component = component_count();
      lowest_.push_back(-1);
      std::vector<int> open{start};
      add_loop(start, {}, component, open);
      while (!open.empty()) {
        const int h = open.back();
        open.pop_back();
        if (loop_[at(h ^ 1)] >= 0) continue;
        const Winding left = winding_[at(loop_[at(h)])];
        const Winding step = step_over(h);
        add_loop(h ^ 1, {left.shape - step.shape, left.tool - step.tool}, component, open);
      }
    }
  }

  void add_loop(int start, Winding winding, int component, std::vector<int>& open) {
    const int loop = static_cast<int>(winding_.size());
    winding_.push_back(winding);
    component_.push_back(component);
    int h = start;
    do {
      loop_[at(h)] = loop;
      open.push_back(h);
      int& lowest = lowest_[at(component)];
      const auto origin = [&](int e) -> const exact::Point& {
        return graph_.points[at(graph_.origin[at(e)])];
      };
      if (lowest < 0 || precedes(origin(h), origin(lowest))) lowest = h;
      h = graph_.next[at(h)];
    } while (h != start);
  }

  // Of the half-edges that leave a component's lowest vertex the one with nothing of it on its left.
  int outermost_at_lowest(int component) const {
    const int start = lowest_[at(component)];
    const auto head = [&](int h) -> const exact::Point& { return graph_.points[at(graph_.target(h))]; };
    const exact::Point& tail = graph_.points[at(graph_.origin[at(start)])];
    int best = start;
    for (int h = graph_.next[at(start ^ 1)]; h != start; h = graph_.next[at(h ^ 1)]) {
      if (orientation(tail, head(best), head(h)) > 0) best = h;
    }
    return best;
  }

  // The true windings of one face of each component shift all of its windings.
  void wind_components() {
    const auto count = lowest_.size();
    std::vector<int> shape_edge(count, -1);
    std::vector<int> chain(count, -1);
    for (int h = 0; h < graph_.half_edge_count(); h += 2) {
      const std::size_t c = at(component_[at(loop_[at(h)])]);
      if (step_over(h).shape != 0) shape_edge[c] = h;
      if (is_chain(h)) chain[c] = h;
    }
    std::vector<Winding> shift(count);
    for (std::size_t c = 0; c < count; ++c) {
      if (chain[c] >= 0) {
        const exact::Point& p = graph_.points[at(graph_.origin[at(chain[c])])];
        shift[c].tool = winding_left_of(tool_, p) - winding_[at(loop_[at(chain[c])])].tool;
      }
      if (chain[c] >= 0 && shape_edge[c] >= 0) {
        shift_by_shape_edge(shape_edge[c], shift[c]);
        continue;
      }
      const int outermost = outermost_at_lowest(static_cast<int>(c));
      const Winding outside = winding_[at(loop_[at(outermost)])];
      const exact::Point& p = graph_.points[at(graph_.origin[at(outermost)])];
      shift[c].tool = winding_left_of(tool_, p) - outside.tool;
      if (shape_edge[c] >= 0) {
        shift_by_shape_edge(shape_edge[c], shift[c]);
      } else {
        shift[c].shape = (is_inside(shape_, p) ? 1 : 0) - outside.shape;
      }
    }
    for (std::size_t i = 0; i < winding_.size(); ++i) {
      const Winding& by = shift[at(component_[i])];
      winding_[i].shape += by.shape;
      winding_[i].tool += tool_winds_ ? by.tool : 0;
    }
  }

  // A valid shape lies on the left of its edges and nowhere else.
  void shift_by_shape_edge(int h, Winding& shift) const {
    const int left = step_over(h).shape > 0 ? h : h ^ 1;
    shift.shape = 1 - winding_[at(loop_[at(left)])].shape;
  }

  bool windings_agree() const {
    for (int h = 0; h < graph_.half_edge_count(); h += 2) {
      const Winding left = winding_[at(loop_[at(h)])];
      const Winding right = winding_[at(loop_[at(h + 1)])];
      const Winding step = step_over(h);
      if (left.shape - right.shape != step.shape || left.tool - right.tool != step.tool) return false;
      if (left.shape < 0 || left.shape > 1 || right.shape < 0 || right.shape > 1) return false;
    }
    return true;
  }

  int root_of(int loop) const {
    while (parent_[at(loop)] != loop) loop = parent_[at(loop)];
    return loop;
  }

  // An edge with one loop on both sides is a dangle or a bridge; one with two has two faces.
  bool is_boundary(int h) const {
    const int left = loop_[at(h)];
    const int right = loop_[at(h ^ 1)];
    if (left == right || (label_[at(left)] < 0 && label_[at(right)] < 0)) return false;
    return seams_ == Seams::kKeep || label_[at(left)] != label_[at(right)];
  }

  void join_loops() {
    parent_.resize(winding_.size());
    std::iota(parent_.begin(), parent_.end(), 0);
    for (int h = 0; h < graph_.half_edge_count(); h += 2) {
      if (is_boundary(h)) continue;
      parent_[at(root_of(loop_[at(h)]))] = root_of(loop_[at(h + 1)]);
    }
    for (std::size_t i = 0; i < parent_.size(); ++i) parent_[i] = root_of(static_cast<int>(i));
  }

  int next_boundary(int h) const {
    int next = graph_.next[at(h)];
    while (!is_boundary(next)) next = graph_.next[at(next ^ 1)];
    return next;
  }

  int first_source(int h) const {
    int source = 1;
    for (const std::size_t s : graph_.sources[at(h / 2)]) source = std::min(source, segments_[s].source);
    return source;
  }

  // As in the general path: a point through which one segment runs straight is a corner only where it parts
  // three regions.
  bool is_corner(int in, int out) const {
    if (is_chain(in) || is_chain(out)) return true;
    const int source = std::min(first_source(in), first_source(out));
    for (const std::size_t s : graph_.sources[at(in / 2)]) {
      if (segments_[s].source != source) continue;
      for (const std::size_t t : graph_.sources[at(out / 2)]) {
        if (s == t) return regions_around(out) > 2;
      }
    }
    return true;
  }

  std::size_t regions_around(int out) const {
    std::set<int> roots;
    int h = out;
    do {
      const int loop = loop_[at(h)];
      roots.insert(label_[at(loop)] < 0 ? -1 : root_of(loop));
      h = graph_.next[at(h ^ 1)];
    } while (h != out);
    return roots.size();
  }

  void trace(int start, std::vector<char>& visited, std::vector<WindowRing>& rings) const {
    std::vector<int> walk;
    std::unordered_map<int, std::size_t> place;  // of each vertex: the half-edge of the walk that ends there
    int h = start;
    do {
      visited[at(h)] = 1;
      walk.push_back(h);
      const auto [seen, is_new] = place.try_emplace(graph_.target(h), walk.size() - 1);
      if (!is_new) {
        // Back at a vertex: what lies between is a ring of its own that touches here.
        const std::size_t from = seen->second + 1;
        for (std::size_t i = from; i + 1 < walk.size(); ++i) place.erase(graph_.target(walk[i]));
        rings.push_back(ring_of({walk.begin() + static_cast<std::ptrdiff_t>(from), walk.end()}));
        walk.resize(from);
      }
      h = next_boundary(h);
    } while (h != start);
    if (!walk.empty()) rings.push_back(ring_of(walk));
  }

  WindowRing ring_of(const std::vector<int>& walk) const {
    WindowRing ring;
    for (std::size_t i = 0; i < walk.size(); ++i) {
      const int h = walk[i];
      if (is_chain(h)) ring.push_back({-1, (h - arranged_) / 2, (h & 1) == 0});
      if (is_corner(h, walk[i + 1 == walk.size() ? 0 : i + 1])) ring.push_back({graph_.target(h)});
    }
    return ring;
  }

  const Rings& shape_;
  const Window& window_;
  const std::vector<SourceSegment>& segments_;
  const std::vector<SourceSegment>& tool_;
  bool tool_winds_;
  Seams seams_ = Seams::kDissolve;
  PlaneGraph graph_;
  int arranged_;                  // half-edges from here on are far chains
  std::vector<int> loop_;         // of each half-edge
  std::vector<Winding> winding_;  // of each loop: on its left
  std::vector<int> component_;    // of each loop
  std::vector<int> lowest_;       // of each component: a half-edge that leaves its lowest vertex
  std::vector<int> label_;        // of each loop
  std::vector<int> parent_;       // of each loop: one of the same region
};

}  // namespace

int winding_left_of(const std::vector<SourceSegment>& tool, const exact::Point& p) {
  int winding = 0;
  for (const SourceSegment& s : tool) {
    if ((s.from.y > p.y) == (s.to.y > p.y)) continue;
    const bool is_upward = s.to.y > s.from.y;
    const int side = orientation(s.from, s.to, p);
    if (side != 0 && (side < 0) == is_upward) winding += is_upward ? -1 : 1;
  }
  return winding;
}

std::optional<WindowOverlay> overlay_in_window(const Rings& shape, const Window& window,
                                               const std::vector<SourceSegment>& tool,
                                               const exact::Classifier& classify, Seams seams) {
  std::vector<SourceSegment> segments;
  segments.reserve(window.near.size() + tool.size());
  for (const EdgeId e : window.near)
    segments.push_back({shape.exact_point(e.ring, e.index), shape.exact_point(e.ring, e.index + 1), 0});
  segments.insert(segments.end(), tool.begin(), tool.end());
  Faces faces(shape, window, segments, tool, seams == Seams::kDissolve);
  if (!faces.build(classify, seams)) return {};
  WindowOverlay result;
  result.boundaries = faces.boundaries();
  faces.find_tool_inside(result);
  result.component_count = faces.component_count();
  result.graph = faces.take_graph();
  return result;
}

}  // namespace polynya::geometry
