#include "geometry/cut/internal/window.hpp"

#include <algorithm>

#include "geometry/exact/internal/edge_tree.hpp"

namespace polynya::geometry {
namespace {

class Marker {
 public:
  explicit Marker(const Rings& rings) : rings_(rings) {
    for (int r = 0; r < rings_.count(); ++r) is_near_.emplace_back(rings_[r].size(), 0);
  }

  void mark(int ring, int index) {
    is_near_[static_cast<std::size_t>(ring)][static_cast<std::size_t>(index)] = 1;
  }

  void mark_near_tool(const std::vector<exact::SourceSegment>& tool) {
    std::vector<Edge> edges;
    Ring ends;
    for (const exact::SourceSegment& s : tool) {
      edges.push_back({exact::rounded(s.from), exact::rounded(s.to)});
      ends.push_back(edges.back().a);
      ends.push_back(edges.back().b);
    }
    const EdgeTree tree(edges);
    for (const EdgeId e : edges_near(rings_, bounding_box(ends))) {
      const Edge edge{rings_.point(e.ring, e.index), rings_.point(e.ring, e.index + 1)};
      const bool is_clear = tree.for_each_near(box_of(edge), [&](std::size_t i) {
        return meet(edge.a, edge.b, edges[i].a, edges[i].b).kind == Meeting::kNone;
      });
      if (!is_clear) mark(e.ring, e.index);
    }
  }

  // Where rings touch, the pieces' boundaries may have to be parted: all of it belongs to the window.
  void mark_touches() {
    const std::vector<Edge> edges = edges_of(rings_.polygon());
    EdgeTree(edges).for_each_pair([&](std::size_t i, std::size_t j) {
      const Edge& e = edges[i];
      const Edge& f = edges[j];
      if (e.ring == f.ring) return true;
      if (meet(e.a, e.b, f.a, f.b).kind == Meeting::kNone) return true;
      mark(e.ring, e.index);
      mark(f.ring, f.index);
      return true;
    });
  }

  Window window() const {
    Window window;
    for (int r = 0; r < rings_.count(); ++r) append_ring(r, window);
    return window;
  }

 private:
  void append_ring(int ring, Window& window) const {
    const std::vector<char>& near = is_near_[static_cast<std::size_t>(ring)];
    const std::size_t n = near.size();
    const auto start = static_cast<std::size_t>(std::find(near.begin(), near.end(), char{1}) - near.begin());
    if (start == n) {
      window.far_rings.push_back(ring);
      return;
    }
    const auto first_near = window.near.size();
    const auto wrap = [n](std::size_t i) { return i < n ? i : i - n; };
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = wrap(start + k);
      if (near[i] != 0) {
        const bool comes_after_chain = k > 0 && near[wrap(i + n - 1)] == 0;
        window.near.push_back({ring, static_cast<int>(i)});
        window.chain_before.push_back(comes_after_chain ? static_cast<int>(window.chains.size()) - 1 : -1);
        window.chain_after.push_back(-1);
      } else if (near[wrap(i + n - 1)] != 0) {
        window.chain_after.back() = static_cast<int>(window.chains.size());
        window.chains.push_back({ring, static_cast<int>(i), 1});
      } else {
        ++window.chains.back().count;
      }
    }
    if (near[wrap(start + n - 1)] == 0)
      window.chain_before[first_near] = static_cast<int>(window.chains.size()) - 1;
  }

  const Rings& rings_;
  std::vector<std::vector<char>> is_near_;
};

}  // namespace

Window open_window(const Rings& shape, const std::vector<exact::SourceSegment>& tool) {
  Marker marker(shape);
  marker.mark_near_tool(tool);
  if (shape.count() > 1) marker.mark_touches();
  return marker.window();
}

}  // namespace polynya::geometry
