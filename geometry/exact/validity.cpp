#include "geometry/exact/validity.hpp"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <set>
#include <tuple>
#include <utility>

#include "geometry/exact/predicates.hpp"
#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry {
namespace {

using Found = std::optional<DefectAt>;

// Two rings that touch in a point, and the edges by which they were found.
struct Touch {
  Point at;
  std::size_t edge_i;
  std::size_t edge_j;
};

Found find_ring_defect(const Ring& ring) {
  for (const Point p : ring) {
    if (!is_usable(p)) return DefectAt{Defect::kNotFinite, {p}};
  }
  const auto differs_from_first = [&](Point p) { return p != ring.front(); };
  const auto second = std::find_if(ring.begin(), ring.end(), differs_from_first);
  const auto third = std::find_if(second, ring.end(), [&](Point p) { return p != ring.front() && p != *second; });
  if (third == ring.end()) return DefectAt{Defect::kTooFewPoints, ring};
  for (std::size_t i = 0; i < ring.size(); ++i) {
    if (ring[i] == ring[(i + 1) % ring.size()]) return DefectAt{Defect::kRepeatedPoint, {ring[i]}};
  }
  const bool on_one_line =
      std::all_of(third, ring.end(), [&](Point p) { return orientation(ring.front(), *second, p) == 0; });
  if (on_one_line) return DefectAt{Defect::kZeroArea, {ring.front(), *second}};
  return {};
}

const Ring& ring_of(const Polygon& polygon, int ring) {
  return ring == 0 ? polygon.outer : polygon.holes[static_cast<std::size_t>(ring) - 1];
}

bool are_neighbours(const Polygon& polygon, const Edge& e, const Edge& f) {
  if (e.ring != f.ring) return false;
  const int last = static_cast<int>(ring_of(polygon, e.ring).size()) - 1;
  const int gap = std::abs(e.index - f.index);
  return gap == 1 || gap == last;
}

// Finds a defect among every pair of edges near each other, or the points at which different rings touch.
Found find_edge_defect(const Polygon& polygon, const std::vector<Edge>& edges, std::vector<Touch>& touches) {
  Found found;
  BoxTree(edges).for_each_pair([&](std::size_t i, std::size_t j) {
    const Edge& e = edges[i];
    const Edge& f = edges[j];
    const SegmentMeeting meeting = meet(e.a, e.b, f.a, f.b);
    if (meeting.kind == Meeting::kNone) return true;
    const std::vector<Point> places{meeting.at, e.a, e.b, f.a, f.b};
    if (meeting.kind == Meeting::kOverlap) {
      found = DefectAt{Defect::kOverlappingEdges, places};
      return false;
    }
    if (e.ring == f.ring) {
      if (!found && !are_neighbours(polygon, e, f)) found = DefectAt{Defect::kSelfCrossing, places};
    } else if (meeting.kind == Meeting::kCross) {
      if (!found) found = DefectAt{Defect::kRingsCross, places};
    } else {
      touches.push_back({meeting.at, i, j});
    }
    // A touch may turn out to be the end of an overlap, which is the better name.
    return !found || meeting.kind == Meeting::kTouch;
  });
  return found;
}

// The two rays along which a ring leaves one of its points: forward and backward.
struct Wedge {
  Ray on;
  Ray back;
};

Wedge wedge_at(const Polygon& polygon, const Edge& e, Point at) {
  const Ring& ring = ring_of(polygon, e.ring);
  const std::size_t n = ring.size();
  const auto i = static_cast<std::size_t>(e.index);
  if (at == e.a) return {{at, e.b}, {at, ring[(i + n - 1) % n]}};
  if (at == e.b) return {{at, ring[(i + 2) % n]}, {at, e.a}};
  return {{at, e.b}, {at, e.a}};
}

Found find_crossing_touch(const Polygon& polygon, const std::vector<Edge>& edges, const std::vector<Touch>& touches) {
  for (const Touch& touch : touches) {
    const Wedge one = wedge_at(polygon, edges[touch.edge_i], touch.at);
    const Wedge other = wedge_at(polygon, edges[touch.edge_j], touch.at);
    const bool on_left = met_before(one.on, other.on, one.back);
    const bool back_left = met_before(one.on, other.back, one.back);
    if (on_left != back_left) return DefectAt{Defect::kRingsCross, {touch.at}};
  }
  return {};
}

// Returns the side of `ring` on which the other ring lies: that of its first vertex off the ring; 0 if it has none.
int side_of(const Ring& other, const Ring& ring) {
  for (const Point p : other) {
    if (const int side = side_of_ring(ring, p); side != 0) return side;
  }
  return 0;
}

Found find_misplaced_hole(const Polygon& polygon) {
  for (const Ring& hole : polygon.holes) {
    if (side_of(hole, polygon.outer) < 0) return DefectAt{Defect::kHoleOutside, hole};
  }
  for (const auto& [i, j] : pairs_of_boxes(boxes_of(polygon.holes, bounding_box))) {
    const Ring& one = polygon.holes[i];
    const Ring& other = polygon.holes[j];
    if (side_of(one, other) > 0 || side_of(other, one) > 0)
      return DefectAt{Defect::kHolesOverlap, {one.front(), other.front()}};
  }
  return {};
}

// Rings and the points at which they touch form a graph. The interior is connected if this graph has no cycle.
Found find_disconnection(const Polygon& polygon, const std::vector<Edge>& edges, const std::vector<Touch>& touches) {
  std::set<std::tuple<double, double, int>> incidences;  // a point, and a ring that touches another ring there
  for (const Touch& touch : touches) {
    for (const std::size_t edge : {touch.edge_i, touch.edge_j})
      incidences.emplace(touch.at.x, touch.at.y, edges[edge].ring);
  }
  std::vector<int> parent(polygon.holes.size() + 1);
  std::iota(parent.begin(), parent.end(), 0);
  const auto root_of = [&parent](int n) {
    while (parent[n] != n) n = parent[n] = parent[parent[n]];
    return n;
  };
  // All rings through one point are connected to the first of them; connecting two that already are closes a cycle.
  std::optional<Point> before;
  int first = 0;
  for (const auto& [x, y, ring] : incidences) {
    const Point at{x, y};
    if (std::exchange(before, at) != at) {
      first = ring;
      continue;
    }
    const int one = root_of(first), other = root_of(ring);
    if (one == other) return DefectAt{Defect::kDisconnected, {at}};
    parent[one] = other;
  }
  return {};
}

Found find_wrong_orientation(const Polygon& polygon) {
  if (area_sign(polygon.outer) < 0) return DefectAt{Defect::kWrongOrientation, {polygon.outer.front()}};
  for (const Ring& hole : polygon.holes) {
    if (area_sign(hole) > 0) return DefectAt{Defect::kWrongOrientation, {hole.front()}};
  }
  return {};
}

}  // namespace

std::string_view name_of(Defect defect) {
  constexpr std::string_view kNames[]{"too-few-points", "not-finite",        "repeated-point",    "zero-area",
                                      "self-crossing",  "overlapping-edges", "wrong-orientation", "hole-outside",
                                      "holes-overlap",  "rings-cross",       "disconnected"};
  return kNames[static_cast<std::size_t>(defect)];
}

std::optional<DefectAt> find_defect(const Polygon& polygon) {
  if (Found found = find_ring_defect(polygon.outer)) return found;
  for (const Ring& hole : polygon.holes) {
    if (Found found = find_ring_defect(hole)) return found;
  }
  const std::vector<Edge> edges = edges_of(polygon);
  std::vector<Touch> touches;
  if (Found found = find_edge_defect(polygon, edges, touches)) return found;
  if (Found found = find_wrong_orientation(polygon)) return found;
  if (Found found = find_crossing_touch(polygon, edges, touches)) return found;
  if (Found found = find_misplaced_hole(polygon)) return found;
  return find_disconnection(polygon, edges, touches);
}

}  // namespace polynya::geometry
