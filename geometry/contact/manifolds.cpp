#include <algorithm>
#include <cmath>

#include "geometry/contact/boundary.hpp"
#include "geometry/shape/avx2_clone.hpp"

namespace polynya::geometry {
namespace {

using Crossing = ManifoldScratch::Crossing;

/// Some pairs of edges side by side, for a loop that the compiler turns into vector instructions. Plain
/// arrays: it does not of those that check their indices.
struct EdgeLanes {
  static constexpr std::size_t kMost = 16;
  double b0x[kMost], b0y[kMost], b1x[kMost], b1y[kMost];  // b's edges in a's frame [m]
  double starts_inside[kMost], is_crossing[kMost];        // 1 or 0
};

/// Brings b's edges into a's frame and finds which pairs cross. Which side of an edge along d a point is on
/// is decided by the sign of its turn, left where it is positive. A zero is decided as if all of b were moved
/// by (ε, ε²), ε → 0: the same tie-break on both boundaries makes crossings alternate between entering and
/// leaving.
POLYNYA_AVX2_CLONE void find_crossing_lanes(const double* ends, std::size_t stride, std::size_t count,
                                            const Pose& a_from_b, EdgeLanes& l) {
  const Pose pose = a_from_b;
  for (std::size_t i = 0; i < count; ++i) {
    const Point a0{ends[i], ends[i + stride]};
    const Point a1{ends[i + 2 * stride], ends[i + 3 * stride]};
    const Point b0 = transform(pose, {ends[i + 4 * stride], ends[i + 5 * stride]});
    const Point b1 = transform(pose, {ends[i + 6 * stride], ends[i + 7 * stride]});
    const Vector da = a1 - a0;
    const Vector db = b1 - b0;
    const Vector ab = b0 - a0;
    const double b_turns[2] = {cross(da, ab), cross(da, b1 - a0)};
    const double a_turns[2] = {-cross(db, ab), cross(db, a1 - b0)};
    const bool a_tie = (da.y < 0) | ((da.y == 0) & (da.x > 0));
    const bool b_tie = (db.y > 0) | ((db.y == 0) & (db.x < 0));
    const bool is_b0_left = (b_turns[0] > 0) | ((b_turns[0] == 0) & a_tie);
    const bool is_b1_left = (b_turns[1] > 0) | ((b_turns[1] == 0) & a_tie);
    const bool is_a0_left = (a_turns[0] > 0) | ((a_turns[0] == 0) & b_tie);
    const bool is_a1_left = (a_turns[1] > 0) | ((a_turns[1] == 0) & b_tie);
    l.b0x[i] = b0.x;
    l.b0y[i] = b0.y;
    l.b1x[i] = b1.x;
    l.b1y[i] = b1.y;
    l.starts_inside[i] = is_a0_left ? 1 : 0;
    l.is_crossing[i] = (is_b0_left != is_b1_left) & (is_a0_left != is_a1_left) ? 1 : 0;
  }
}

void find_crossings(const Pose& a_from_b, const NearEdges& edges, std::vector<Crossing>& crossings) {
  EdgeLanes lanes;
  for (std::size_t first = 0; first < edges.pairs.size(); first += EdgeLanes::kMost) {
    const double* ends = edges.ends.data() + first;
    const std::size_t count = std::min(EdgeLanes::kMost, edges.pairs.size() - first);
    find_crossing_lanes(ends, edges.stride, (count + 3) / 4 * 4, a_from_b, lanes);
    for (std::size_t i = 0; i < count; ++i) {
      if (lanes.is_crossing[i] == 0) continue;
      const Point a0{ends[i], ends[i + edges.stride]};
      const Point b0{lanes.b0x[i], lanes.b0y[i]};
      const Vector da = Point{ends[i + 2 * edges.stride], ends[i + 3 * edges.stride]} - a0;
      const Vector db = Point{lanes.b1x[i], lanes.b1y[i]} - b0;
      const Vector ab = b0 - a0;
      const double turn = cross(da, db);
      const double per_turn = 1 / turn;
      const double along_a = turn != 0 ? std::clamp(cross(ab, db) * per_turn, 0.0, 1.0) : 0.5;
      const double along_b = turn != 0 ? std::clamp(cross(ab, da) * per_turn, 0.0, 1.0) : 0.5;
      const NearPair pair = edges.pairs[first + i];
      crossings.push_back(
          {a0 + along_a * da, pair.a, pair.b, along_a, along_b, lanes.starts_inside[i] == 0, 0});
    }
  }
}

/// Crossings at one place of an edge come in either order by rounding; along a ring they must enter and leave
/// in turn. `at(i)` is the i-th crossing of the order, by reference; only crossings of one ring follow one
/// another.
template <typename At, typename RingOf, typename IsSamePlace>
void alternate_ties(std::size_t count, At at, RingOf ring_of, IsSamePlace is_same_place) {
  for (std::size_t i = 0; i + 1 < count; ++i) {
    const std::uint32_t ring = ring_of(at(i));
    bool last_was_entering = false;
    if (i > 0 && ring_of(at(i - 1)) == ring) {
      last_was_entering = at(i - 1).is_entering;
    } else {  // the ring's first crossing follows its last
      std::size_t last = i;
      while (last + 1 < count && ring_of(at(last + 1)) == ring) ++last;
      last_was_entering = at(last).is_entering;
    }
    if (at(i).is_entering != last_was_entering) continue;
    for (std::size_t k = i + 1; k < count && ring_of(at(k)) == ring && is_same_place(at(i), at(k)); ++k) {
      if (at(k).is_entering == at(i).is_entering) continue;
      std::swap(at(i), at(k));
      break;
    }
  }
}

constexpr double kSamePlace = 1e-9;  ///< along an edge, as a share of it

bool is_before_on_a(const Crossing& p, const Crossing& q) {
  return p.edge_a != q.edge_a ? p.edge_a < q.edge_a : p.along_a < q.along_a;
}
bool is_before_on_b(const Crossing& p, const Crossing& q) {
  return p.edge_b != q.edge_b ? p.edge_b < q.edge_b : p.along_b < q.along_b;
}

/// What a chain of vertices adds to a manifold: area between chain and contact line, and how far it reaches
/// off it.
struct ChainExtent {
  double area = 0;
  double depth = 0;
  Point tip;
  std::uint32_t tip_edge = 0;
  bool is_closed = false;  ///< the chain did arrive
};

/// Walks `edges` from a point on edge `first` to a point on edge `last`, measuring along `outward` from the
/// line. Writes the chain's points as (along the line, off the line) into `profile`.
template <typename InFrame>
ChainExtent walk(const EdgeList& edges, std::uint32_t first, Point from, std::uint32_t last, Point to,
                 double width, Vector outward, bool wraps, InFrame in_frame, std::vector<Point>& profile) {
  constexpr int kMostVertices = 4096;  // a stretch this long is no contact: the bodies lie deep in each other
  ChainExtent extent;
  extent.tip = midpoint(from, to);
  extent.tip_edge = first;
  const Vector along = perpendicular(outward);
  profile.clear();
  profile.push_back({0, 0});
  Point previous = from;
  std::uint32_t edge = first;
  for (int k = 0; k < kMostVertices && (edge != last || wraps); ++k) {
    wraps = false;
    edge = edges.next[edge];
    const Point vertex = in_frame(edges.from(edge));
    extent.area += 0.5 * cross(previous - from, vertex - from);
    const double off = dot(vertex - from, outward);
    profile.push_back({dot(vertex - from, along), off});
    if (off > extent.depth) {
      extent.depth = off;
      extent.tip = vertex;
      extent.tip_edge = edge;
    }
    previous = vertex;
  }
  profile.push_back({width, 0});
  extent.area += 0.5 * cross(previous - from, to - from);
  extent.is_closed = edge == last;
  return extent;
}

/// How far a profile reaches off the line at a place along it, at most.
double off_at(const std::vector<Point>& profile, double along) {
  double off = 0;
  for (std::size_t i = 1; i < profile.size(); ++i) {
    const Point p = profile[i - 1];
    const Point q = profile[i];
    if (std::min(p.x, q.x) > along || std::max(p.x, q.x) < along) continue;
    off = std::max({off, q.x == p.x ? std::max(p.y, q.y) : p.y + (along - p.x) / (q.x - p.x) * (q.y - p.y)});
  }
  return off;
}

/// Greatest thickness of the overlap across the contact line: it is at a vertex of either side. The sides'
/// greatest extents do not simply add: two faces shifted along each other reach farthest at opposite ends of
/// the line.
double thickness_of(const std::vector<Point>& a_side, const std::vector<Point>& b_side, double line) {
  constexpr std::size_t kMostProduct =
      4096;  // beyond, the sum is near enough for bodies that lie deep in each other
  double most = 0;
  double sum = 0;
  for (const Point p : a_side) sum = std::max(sum, p.y);
  const double a_extent = sum;
  if (b_side.size() == 2) return a_extent;  // a straight side is the line itself
  for (const Point p : b_side) sum = std::max(sum, a_extent + p.y);
  if (a_side.size() == 2 || a_side.size() * b_side.size() > kMostProduct) return sum;
  for (const Point p : a_side) most = std::max(most, p.y + off_at(b_side, line - p.x));
  for (const Point p : b_side) most = std::max(most, p.y + off_at(a_side, line - p.x));
  return most;
}

/// The crossings of two boundaries, in their orders along both.
void order_crossings(const Boundary& a, const Boundary& b, ManifoldScratch& scratch) {
  std::vector<Crossing>& by_a = scratch.crossings;
  std::sort(by_a.begin(), by_a.end(), is_before_on_a);
  alternate_ties(
      by_a.size(), [&](std::size_t i) -> Crossing& { return by_a[i]; },
      [&](const Crossing& p) { return a.edges.ring[p.edge_a]; },
      [](const Crossing& p, const Crossing& q) {
        return p.edge_a == q.edge_a && std::abs(p.along_a - q.along_a) < kSamePlace;
      });
  for (std::uint32_t i = 0; i < by_a.size(); ++i) by_a[i].place_on_a = i;
  std::vector<Crossing>& by_b = scratch.by_b;
  by_b = by_a;
  std::sort(by_b.begin(), by_b.end(), is_before_on_b);
  alternate_ties(
      by_b.size(), [&](std::size_t i) -> Crossing& { return by_b[i]; },
      [&](const Crossing& p) { return b.edges.ring[p.edge_b]; },
      [](const Crossing& p, const Crossing& q) {
        return p.edge_b == q.edge_b && std::abs(p.along_b - q.along_b) < kSamePlace;
      });
}

/// The crossing that follows number i along its ring, in an order of crossings.
template <typename RingOf>
std::size_t next_on_ring(const std::vector<Crossing>& order, std::size_t i, RingOf ring_of) {
  const std::uint32_t ring = ring_of(order[i]);
  if (i + 1 < order.size() && ring_of(order[i + 1]) == ring) return i + 1;
  while (i > 0 && ring_of(order[i - 1]) == ring) --i;
  return i;
}

/// The manifold of one stretch of a's boundary inside b, from its entering to its leaving crossing; false
/// where its sides do not close.
bool make_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b, const Crossing& enter,
                   const Crossing& leave, bool closes_on_b, ManifoldScratch& scratch,
                   ContactManifold& manifold) {
  const Vector line = leave.point - enter.point;
  manifold.width = length(line);
  if (manifold.width < 1e-12) return false;
  manifold.normal = (-1 / manifold.width) * perpendicular(line);
  const auto as_is = [](Point p) { return p; };
  const auto from_b = [&](Point p) { return transform(a_from_b, p); };
  const ChainExtent on_a =
      walk(a.edges, enter.edge_a, enter.point, leave.edge_a, leave.point, manifold.width, manifold.normal,
           enter.edge_a == leave.edge_a && !is_before_on_a(enter, leave), as_is, scratch.side_a);
  manifold.area = on_a.area;
  manifold.depth = on_a.depth;
  manifold.tip_of_b = midpoint(enter.point, leave.point);
  manifold.tip_edge_of_b = enter.edge_b;
  bool is_closed = on_a.is_closed;
  if (closes_on_b) {
    const ChainExtent on_b =
        walk(b.edges, leave.edge_b, leave.point, enter.edge_b, enter.point, manifold.width, -manifold.normal,
             leave.edge_b == enter.edge_b && !is_before_on_b(leave, enter), from_b, scratch.side_b);
    manifold.area += on_b.area;
    manifold.depth = thickness_of(scratch.side_a, scratch.side_b, manifold.width);
    if (on_b.depth > 0) {
      manifold.tip_of_b = on_b.tip;
      manifold.tip_edge_of_b = on_b.tip_edge;
    }
    is_closed = is_closed && on_b.is_closed;
  }
  manifold.ends[0] = enter.point;
  manifold.ends[1] = leave.point;
  manifold.area = std::max(manifold.area, 0.0);
  return is_closed;
}

/// Appends the manifold of a stretch; returns 1 where there is none.
int add_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b, const Crossing& enter,
                 const Crossing& leave, bool closes_on_b, ManifoldScratch& scratch,
                 std::vector<ContactManifold>& manifolds) {
  manifolds.emplace_back();
  if (make_manifold(a, b, a_from_b, enter, leave, closes_on_b, scratch, manifolds.back())) return 0;
  manifolds.pop_back();
  return 1;
}

}  // namespace

int find_manifolds(const Boundary& a, const Boundary& b, const Pose& a_from_b, const NearEdges& edges,
                   ManifoldScratch& scratch, std::vector<ContactManifold>& manifolds) {
  const std::vector<Crossing>& by_a = scratch.crossings;
  const std::vector<Crossing>& by_b = scratch.by_b;
  scratch.crossings.clear();
  find_crossings(a_from_b, edges, scratch.crossings);
  if (by_a.empty()) return 0;
  if (by_a.size() == 2 &&
      by_a[0].is_entering != by_a[1].is_entering) {  // nearly all contacts: no order to find
    const bool is_first = by_a[0].is_entering;
    return add_manifold(a, b, a_from_b, by_a[is_first ? 0 : 1], by_a[is_first ? 1 : 0], true, scratch,
                        manifolds);
  }
  order_crossings(a, b, scratch);
  const auto ring_on_a = [&](const Crossing& p) { return a.edges.ring[p.edge_a]; };
  const auto ring_on_b = [&](const Crossing& p) { return b.edges.ring[p.edge_b]; };

  int left_out = 0;
  for (std::size_t i = 0; i < by_a.size(); ++i) {
    if (!by_a[i].is_entering) continue;
    const std::size_t j = next_on_ring(by_a, i, ring_on_a);
    std::size_t j_on_b = 0;
    while (by_b[j_on_b].place_on_a != j) ++j_on_b;
    const bool closes_on_b = by_b[next_on_ring(by_b, j_on_b, ring_on_b)].place_on_a == i;
    left_out += by_a[j].is_entering
                    ? 1
                    : add_manifold(a, b, a_from_b, by_a[i], by_a[j], closes_on_b, scratch, manifolds);
  }
  return left_out;
}

}  // namespace polynya::geometry
