#include <algorithm>
#include <tuple>

#include "geometry/cut/internal/local_cut.hpp"
#include "geometry/shape/box_tree.hpp"

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

std::vector<Edge> edges_of(const std::vector<Segment>& segments) {
  std::vector<Edge> edges;
  for (const Segment& s : segments) edges.push_back({s.from, s.to});
  return edges;
}

std::vector<Point> rounded_nodes(const std::vector<Node>& nodes) {
  std::vector<Point> points;
  for (const Node& node : nodes) {
    if (node.is_active && node.is_rounded) points.push_back(node.at);
  }
  return points;
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

// No point twice?
bool are_distinct(std::vector<Point> points) {
  std::sort(points.begin(), points.end(), precedes);
  return std::adjacent_find(points.begin(), points.end()) == points.end();
}

// Has every edge a length, and do they meet in shared ends only?
bool are_apart(const std::vector<Segment>& changed) {
  const auto has_no_length = [](const Segment& s) { return s.from == s.to; };
  if (std::any_of(changed.begin(), changed.end(), has_no_length)) return false;
  const std::vector<Edge> edges = edges_of(changed);
  return BoxTree(edges).for_each_pair([&](std::size_t i, std::size_t j) { return are_apart(changed[i], changed[j]); });
}

// Do the changed edges meet these others in shared ends only?
bool are_clear_of(const std::vector<Segment>& changed, const std::vector<Segment>& others) {
  const std::vector<Edge> edges = edges_of(changed);
  const BoxTree tree(edges);
  return std::all_of(others.begin(), others.end(), [&](const Segment& t) {
    return tree.for_each_near(box_of(Edge{t.from, t.to}), [&](std::size_t i) { return are_apart(changed[i], t); });
  });
}

}  // namespace

// Only edges that end in a rounded node can have come to meet another: all others lie as they did in the
// exact subdivision, where edges meet in nodes only. So only these are checked, against all edges near them.
bool changed_edges_are_apart(const LocalCut& cut, const Box& tool_box, const std::vector<EdgeId>& near_tool) {
  if (cut.changed.empty()) return true;
  if (!are_distinct(rounded_nodes(cut.nodes)) || !are_apart(cut.changed)) return false;
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

}  // namespace polynya::geometry
