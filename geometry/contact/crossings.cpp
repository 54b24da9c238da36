#include <algorithm>
#include <bit>
#include <cmath>

#include "geometry/contact/manifolds.hpp"
#include "geometry/shape/avx2_clone.hpp"

namespace polynya::geometry {
namespace {

using Crossing = ManifoldScratch::Crossing;

/// Some pairs of edges side by side, for a loop that the compiler turns into vector instructions. Plain
/// arrays: it does not of those that check their indices.
struct EdgeLanes {
  // Four vector instructions of four doubles. Fewer leave their time to the loop, more to lanes that are not
  // used.
  static constexpr std::size_t kMost = 16;
  double along_a[kMost], along_b[kMost];            // where their lines meet, as shares of the edges
  double starts_inside[kMost], is_crossing[kMost];  // 1 or 0
};

/// Brings b's edges into a's frame and finds which pairs cross. Which side of an edge along d a point is on
/// is decided by the sign of its turn, left where it is positive. A zero is decided as if all of b were moved
/// by (ε, ε²), ε → 0: the same tie-break on both boundaries makes crossings alternate between entering and
/// leaving.
POLYNYA_AVX2_CLONE void find_crossing_lanes(const double* __restrict ends, std::size_t stride, std::size_t count,
                                            const Pose& a_from_b, EdgeLanes& __restrict l) {
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
    const double turn = cross(da, db);
    const double per_turn = 1 / turn;
    l.along_a[i] = turn != 0 ? std::clamp(cross(ab, db) * per_turn, 0.0, 1.0) : 0.5;
    l.along_b[i] = turn != 0 ? std::clamp(cross(ab, da) * per_turn, 0.0, 1.0) : 0.5;
    l.starts_inside[i] = is_a0_left ? 1 : 0;
    l.is_crossing[i] = (is_b0_left != is_b1_left) & (is_a0_left != is_a1_left) ? 1 : 0;
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

/// Along an edge, as a share of it [-]. Far smaller, crossings that rounding swapped are not put in turn, and
/// their overlap is left out for a step; far larger, crossings of different corners are swapped.
constexpr double kSamePlace = 1e-9;

}  // namespace

bool is_before_on_a(const Crossing& p, const Crossing& q) {
  return p.edge_a != q.edge_a ? p.edge_a < q.edge_a : p.along_a < q.along_a;
}
bool is_before_on_b(const Crossing& p, const Crossing& q) {
  return p.edge_b != q.edge_b ? p.edge_b < q.edge_b : p.along_b < q.along_b;
}

void find_crossings(const Pose& a_from_b, const NearEdges& edges, std::vector<Crossing>& crossings) {
  EdgeLanes lanes;
  for (std::size_t first = 0; first < edges.pairs.size(); first += EdgeLanes::kMost) {
    const double* ends = edges.ends.data() + first;
    const std::size_t count = std::min(EdgeLanes::kMost, edges.pairs.size() - first);
    find_crossing_lanes(ends, edges.stride, (count + 3) / 4 * 4, a_from_b, lanes);
    unsigned which = 0;  // those that cross, a bit each: without a branch for every pair
    for (std::size_t i = 0; i < count; ++i) which |= static_cast<unsigned>(lanes.is_crossing[i]) << i;
    for (; which != 0; which &= which - 1) {
      const auto i = static_cast<std::size_t>(std::countr_zero(which));
      const Point a0{ends[i], ends[i + edges.stride]};
      const Vector da = Point{ends[i + 2 * edges.stride], ends[i + 3 * edges.stride]} - a0;
      const NearPair pair = edges.pairs[first + i];
      crossings.push_back({a0 + lanes.along_a[i] * da, pair.a, pair.b, lanes.along_a[i], lanes.along_b[i],
                           lanes.starts_inside[i] == 0, 0});
    }
  }
}

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

std::size_t next_on_ring(const std::vector<Crossing>& order, std::size_t i, const std::vector<std::uint32_t>& ring,
                         std::uint32_t Crossing::*edge) {
  const std::uint32_t own = ring[order[i].*edge];
  if (i + 1 < order.size() && ring[order[i + 1].*edge] == own) return i + 1;
  while (i > 0 && ring[order[i - 1].*edge] == own) --i;
  return i;
}

}  // namespace polynya::geometry
