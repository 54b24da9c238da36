#include "geometry/internal/subdivision_check.hpp"

#include <algorithm>
#include <tuple>

#include "geometry/internal/edge_tree.hpp"

namespace polynya::geometry {
namespace {

enum class End { kNone, kExact, kRounded };

End end_at(const Segment& s, Point p) {
  if (p == s.from) return s.from_is_rounded ? End::kRounded : End::kExact;
  if (p == s.to) return s.to_is_rounded ? End::kRounded : End::kExact;
  return End::kNone;
}

// Two edges of a subdivision may share an end, and nothing else. A rounded node that came to lie on some
// other vertex is not an end they share.
bool are_apart(const Segment& s, const Segment& t) {
  const SegmentMeeting meeting = meet(s.from, s.to, t.from, t.to);
  if (meeting.kind == Meeting::kNone) return true;
  const End end = end_at(s, meeting.at);
  return meeting.kind == Meeting::kTouch && end != End::kNone && end == end_at(t, meeting.at);
}

bool rounded_nodes_are_distinct(const std::vector<Node>& nodes) {
  std::vector<std::pair<double, double>> points;
  for (const Node& node : nodes) {
    if (node.is_active && node.is_rounded) points.emplace_back(node.at.x, node.at.y);
  }
  std::sort(points.begin(), points.end());
  return std::adjacent_find(points.begin(), points.end()) == points.end();
}

// The nodes come in order along the shape.
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

bool holds(const Box& outer, const Box& inner) {
  return outer.low.x <= inner.low.x && outer.low.y <= inner.low.y && inner.high.x <= outer.high.x &&
         inner.high.y <= outer.high.y;
}

}  // namespace

// Only edges that end in a rounded node can have come to meet another: all others lie as they did in the
// exact subdivision, where edges meet in nodes only. So these few are held against all that is near them.
bool changed_edges_are_apart(const LocalCut& cut, const Box& tool_box, const std::vector<EdgeId>& near_tool) {
  if (cut.changed.empty()) return true;
  if (!rounded_nodes_are_distinct(cut.nodes)) return false;
  std::vector<Edge> edges;
  edges.reserve(cut.changed.size());
  Ring ends;
  for (const Segment& s : cut.changed) {
    if (s.from == s.to) return false;
    edges.push_back({s.from, s.to});
    ends.push_back(s.from);
    ends.push_back(s.to);
  }
  const EdgeTree tree(edges);
  const auto clears = [&](const Segment& t) {
    return tree.for_each_near(box_of(Edge{t.from, t.to}),
                              [&](std::size_t i) { return are_apart(cut.changed[i], t); });
  };
  if (!tree.for_each_pair(
          [&](std::size_t i, std::size_t j) { return are_apart(cut.changed[i], cut.changed[j]); })) {
    return false;
  }
  if (!std::all_of(cut.placed.begin(), cut.placed.end(), clears)) return false;
  const Box box = bounding_box(ends);
  const std::vector<EdgeId> near = holds(tool_box, box) ? near_tool : edges_near(cut.rings, box);
  return std::all_of(near.begin(), near.end(), [&](EdgeId e) {
    return is_split(cut, e) ||
           clears({cut.rings.point(e.ring, e.index), cut.rings.point(e.ring, e.index + 1)});
  });
}

}  // namespace polynya::geometry
