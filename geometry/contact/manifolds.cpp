#include "geometry/contact/manifolds.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/exact/predicates.hpp"
#include "geometry/shape/avx2_clone.hpp"

namespace polynya::geometry {
namespace {

using Crossing = ManifoldScratch::Crossing;

// ---- crossings of boundaries

/// Some pairs of edges side by side, for a loop that the compiler turns into vector instructions. The arrays are plain,
/// because the compiler does not vectorise arrays that check their indices.
struct EdgeLanes {
  // Four vector instructions of four doubles. Fewer: more time in the loop itself. More: more unused lanes.
  static constexpr std::size_t kMost = 16;
  double along_a[kMost], along_b[kMost];  // place at which their lines cross, as fractions of the edges
  double starts_inside[kMost];            // 1 or 0
};
/// One bit for each lane.
constexpr std::array<std::uint64_t, EdgeLanes::kMost> kLaneBits = [] {
  std::array<std::uint64_t, EdgeLanes::kMost> bits{};
  for (std::size_t i = 0; i < bits.size(); ++i) bits[i] = std::uint64_t{1} << i;
  return bits;
}();

/// Transforms b's edges to a's frame and finds the pairs that cross; returns the bits of their lanes. The side of an
/// edge along d on which a point lies follows from the sign of the cross product; positive is left. A zero is decided
/// as if all of b were moved by (ε, ε²), ε → 0. The same tie-break on both boundaries makes crossings alternate between
/// entering and leaving.
POLYNYA_AVX2_CLONE std::uint64_t find_crossing_lanes(const double* __restrict ends, std::size_t stride,
                                                     std::size_t count, const Pose& a_from_b, EdgeLanes& __restrict l) {
  const Pose pose = a_from_b;
  const std::uint64_t* bits = kLaneBits.data();
  std::uint64_t which = 0;
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
    which |= (is_b0_left != is_b1_left) & (is_a0_left != is_a1_left) ? bits[i] : 0;
  }
  return which;
}

/// Distance along an edge, as a fraction of it, within which crossings count as being at one place [-]. Far smaller:
/// crossings that rounding has swapped are not put in order, and their overlap is left out for a step. Far larger:
/// crossings of different corners are swapped.
constexpr double kSamePlace = 1e-9;

/// One of the two boundaries, on which crossings have their places.
struct Side {
  std::uint32_t Crossing::*edge;
  double Crossing::*along;
};
constexpr Side kOnA{&Crossing::edge_a, &Crossing::along_a};
constexpr Side kOnB{&Crossing::edge_b, &Crossing::along_b};

bool is_before(const Crossing& p, const Crossing& q, Side on) {
  return p.*on.edge != q.*on.edge ? p.*on.edge < q.*on.edge : p.*on.along < q.*on.along;
}

/// Sorts crossings along a boundary. Crossings at one place of an edge may be in either order through rounding; along a
/// ring they must enter and leave alternately. `ring` is the boundary's ring of each edge.
void order_along(Side on, const std::vector<std::uint32_t>& ring, std::vector<Crossing>& order) {
  std::sort(order.begin(), order.end(), [on](const Crossing& p, const Crossing& q) { return is_before(p, q, on); });
  const auto ring_of = [&](std::size_t i) { return ring[order[i].*on.edge]; };
  for (std::size_t i = 0; i + 1 < order.size(); ++i) {
    const std::uint32_t own = ring_of(i);
    std::size_t before = i - 1;
    if (i == 0 || ring_of(i - 1) != own) {  // the ring's first crossing follows its last one
      before = i;
      while (before + 1 < order.size() && ring_of(before + 1) == own) ++before;
    }
    if (order[i].is_entering != order[before].is_entering) continue;
    const auto is_same_place = [&](const Crossing& q) {
      return order[i].*on.edge == q.*on.edge && std::abs(order[i].*on.along - q.*on.along) < kSamePlace;
    };
    for (std::size_t k = i + 1; k < order.size() && ring_of(k) == own && is_same_place(order[k]); ++k) {
      if (order[k].is_entering == order[i].is_entering) continue;
      std::swap(order[i], order[k]);
      break;
    }
  }
}

/// Appends the crossings of near edges of two boundaries, in the frame of a. A touch counts as if b were moved by (ε,
/// ε²), ε → 0, so that along each ring crossings enter and leave alternately.
void find_crossings(const Pose& a_from_b, const NearEdges& edges, std::vector<Crossing>& crossings) {
  EdgeLanes lanes;
  for (std::size_t first = 0; first < edges.pairs.size(); first += EdgeLanes::kMost) {
    const double* ends = edges.ends.data() + first;
    const std::size_t count = std::min(EdgeLanes::kMost, edges.pairs.size() - first);
    std::uint64_t which = find_crossing_lanes(ends, edges.stride, (count + 3) / 4 * 4, a_from_b, lanes);
    which &= (std::uint64_t{1} << count) - 1;
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

/// Returns the crossing that follows number i along its ring, in an order of crossings.
std::size_t next_on_ring(const std::vector<Crossing>& order, std::size_t i, const std::vector<std::uint32_t>& ring,
                         Side on) {
  const std::uint32_t own = ring[order[i].*on.edge];
  if (i + 1 < order.size() && ring[order[i + 1].*on.edge] == own) return i + 1;
  while (i > 0 && ring[order[i - 1].*on.edge] == own) --i;
  return i;
}

// ---- overlaps of boundaries that cross more than twice

/// Calls use(edge) for the vertices, at which edges start, after a point on edge `first` and up to a point on edge
/// `last`. If both points are on one edge, `wraps` is true to go around the whole ring. Returns true if `last` was
/// reached.
template <typename Use>
bool for_vertices_between(const EdgeList& edges, std::uint32_t first, std::uint32_t last, bool wraps, Use use) {
  std::uint32_t edge = first;
  for (std::size_t left = edges.size(); left > 0 && (edge != last || wraps); --left) {
    wraps = false;
    edge = edges.next[edge];
    use(edge);
  }
  return edge == last;
}

void write_points(const BoundaryPair& pair, ManifoldScratch& scratch, OverlapLoop& loop) {
  std::vector<OverlapPoint>& points = scratch.loop_points;
  loop.first_point = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t s = loop.first; s < loop.first + loop.stretches; ++s) {
    const OverlapStretch& stretch = scratch.stretches[s];
    const Crossing& enter = scratch.crossings[stretch.enter];
    const Crossing& leave = scratch.crossings[stretch.leave];
    const Crossing& next = scratch.crossings[stretch.next];
    // If two crossings are on one edge, their order decides instead of their places, which may be equal.
    const bool wraps_a = enter.edge_a == leave.edge_a && stretch.leave < stretch.enter;
    const bool wraps_b =
        leave.edge_b == next.edge_b && scratch.place_on_b[stretch.next] < scratch.place_on_b[stretch.leave];
    points.push_back({enter.point, enter.edge_b});
    for_vertices_between(pair.a.edges, enter.edge_a, leave.edge_a, wraps_a, [&](std::uint32_t edge) {
      points.push_back({pair.a.edges.from(edge), kNotOnB});
    });
    points.push_back({leave.point, leave.edge_b});
    for_vertices_between(pair.b.edges, leave.edge_b, next.edge_b, wraps_b, [&](std::uint32_t edge) {
      points.push_back({transform(pair.a_from_b, pair.b.edges.from(edge)), edge});
    });
  }
  loop.points = static_cast<std::uint32_t>(points.size()) - loop.first_point;
}

/// The area of an overlap and its first moments about an origin.
struct OverlapMoments {
  Point origin;
  double area = 0;  ///< [m²]
  Vector first;     ///< [m³]

  void add_edge(Point p, Point q) {
    const Vector u = p - origin;
    const Vector v = q - origin;
    const double twice = cross(u, v);
    area += 0.5 * twice;
    first += (twice / 6) * (u + v);
  }
};

std::span<const OverlapPoint> points_of(const ManifoldScratch& scratch, const OverlapLoop& loop) {
  return std::span(scratch.loop_points).subspan(loop.first_point, loop.points);
}

void add_loop(OverlapMoments& moments, std::span<const OverlapPoint> points) {
  for_ring_edges(points, [&](const OverlapPoint& p, const OverlapPoint& q) { moments.add_edge(p.point, q.point); });
}

bool is_inside(std::span<const OverlapPoint> points, Point p) {
  bool inside = false;
  for_ring_edges(points, [&](const OverlapPoint& from, const OverlapPoint& to) {
    if (crosses_ray(from.point, to.point, p)) inside = !inside;
  });
  return inside;
}

bool is_hole_of(const ManifoldScratch& scratch, std::size_t hole, std::size_t outer) {
  return scratch.loops[outer].area > 0 &&
         is_inside(points_of(scratch, scratch.loops[outer]), points_of(scratch, scratch.loops[hole])[0].point);
}

/// Subtracts from an overlap the holes of one body that lie completely in it, without a crossing.
template <typename InFrame, typename IsCrossed>
void add_whole_holes(const EdgeList& edges, InFrame in_frame, IsCrossed is_crossed, std::span<const OverlapPoint> outer,
                     OverlapMoments& moments) {
  std::size_t end = 0;
  for (std::size_t first = 0; first < edges.size(); first = end) {
    const std::uint32_t ring = edges.ring[first];
    for (end = first; end < edges.size() && edges.ring[end] == ring;) ++end;
    if (ring == 0 || is_crossed(ring) || !is_inside(outer, in_frame(edges.vertices[first]))) continue;
    for (auto edge = static_cast<std::uint32_t>(first); edge < end; ++edge)
      moments.add_edge(in_frame(edges.from(edge)), in_frame(edges.to(edge)));
  }
}

void add_holes_of_both(const BoundaryPair& pair, const ManifoldScratch& scratch, const OverlapLoop& loop,
                       OverlapMoments& moments) {
  const auto points = points_of(scratch, loop);
  const auto is_crossed = [&scratch](const EdgeList& edges, Side on) {
    return [&, on](std::uint32_t ring) {
      return std::ranges::any_of(scratch.crossings, [&](const Crossing& c) { return edges.ring[c.*on.edge] == ring; });
    };
  };
  add_whole_holes(
      pair.a.edges, [](Point p) { return p; }, is_crossed(pair.a.edges, kOnA), points, moments);
  add_whole_holes(
      pair.b.edges, [&](Point p) { return transform(pair.a_from_b, p); }, is_crossed(pair.b.edges, kOnB), points,
      moments);
}

struct Range {
  double low = std::numeric_limits<double>::infinity();
  double high = -std::numeric_limits<double>::infinity();
  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  double extent() const { return high - low; }
};

template <typename Use>
void for_loops_of(const ManifoldScratch& scratch, const OverlapLoop& outer, Use use) {
  for (const OverlapLoop& loop : scratch.loops) {
    if (&scratch.loops[loop.outer] == &outer) use(loop);
  }
}

/// Traces the boundaries of all overlaps of two bodies from the scratch's ordered crossings into the scratch's loops,
/// sorted by their first crossing along a. A loop that does not close is marked.
void trace_loops(const Boundary& a, const Boundary& b, ManifoldScratch& scratch) {
  const std::vector<Crossing>& by_a = scratch.crossings;
  const std::vector<Crossing>& by_b = scratch.by_b;
  scratch.place_on_b.resize(by_b.size());
  for (std::uint32_t i = 0; i < by_b.size(); ++i) scratch.place_on_b[by_b[i].place_on_a] = i;
  scratch.is_traced.assign(by_a.size(), false);
  scratch.stretches.clear();
  scratch.loops.clear();
  for (std::uint32_t start = 0; start < by_a.size(); ++start) {
    if (!by_a[start].is_entering || scratch.is_traced[start]) continue;
    OverlapLoop loop;
    loop.first = static_cast<std::uint32_t>(scratch.stretches.size());
    std::uint32_t enter = start;
    do {
      scratch.is_traced[enter] = true;
      const auto leave = static_cast<std::uint32_t>(next_on_ring(by_a, enter, a.edges.ring, kOnA));
      const std::size_t next_on_b = next_on_ring(by_b, scratch.place_on_b[leave], b.edges.ring, kOnB);
      const std::uint32_t next = by_b[next_on_b].place_on_a;
      scratch.stretches.push_back({enter, leave, next});
      loop.is_closed = !by_a[leave].is_entering && next == start;
      if (by_a[leave].is_entering || !by_a[next].is_entering || scratch.is_traced[next]) break;
      enter = next;
    } while (true);
    loop.stretches = static_cast<std::uint32_t>(scratch.stretches.size()) - loop.first;
    loop.outer = static_cast<std::uint32_t>(scratch.loops.size());
    scratch.loops.push_back(loop);
  }
}

/// Writes the points of each loop and finds which loops are holes of which others. This is done only if a body has
/// holes, or if a loop has several stretches of a boundary.
void measure_loops(const BoundaryPair& pair, ManifoldScratch& scratch) {
  const bool has_holes = pair.a.edges.has_holes() || pair.b.edges.has_holes();
  scratch.loop_points.clear();
  for (OverlapLoop& loop : scratch.loops) {
    if (!loop.is_closed || (loop.stretches == 1 && !has_holes)) continue;
    write_points(pair, scratch, loop);
    OverlapMoments moments{scratch.loop_points[loop.first_point].point, 0, {}};
    add_loop(moments, points_of(scratch, loop));
    loop.area = moments.area;
  }
  if (!has_holes) return;
  for (std::uint32_t hole = 0; hole < scratch.loops.size(); ++hole) {
    if (scratch.loops[hole].area >= 0) continue;
    for (std::uint32_t outer = 0; outer < scratch.loops.size(); ++outer) {
      if (!is_hole_of(scratch, hole, outer)) continue;
      scratch.loops[hole].outer = outer;
      scratch.loops[outer].has_holes = true;
    }
  }
}

/// Returns the area of the bodies' holes that lie completely in the overlap of a loop with one stretch [m²].
double area_of_whole_holes(const BoundaryPair& pair, const ManifoldScratch& scratch, const OverlapLoop& loop) {
  if (loop.points == 0) return 0;  // no body has holes
  OverlapMoments moments{scratch.loop_points[loop.first_point].point, 0, {}};
  add_holes_of_both(pair, scratch, loop, moments);
  return -moments.area;
}

/// Returns the manifold of a connected overlap with any number of stretches, from the gradient of its area
/// (docs/theory/contact.md). `outer` is its outer loop. The area is 0 if there is none.
ContactManifold gradient_manifold(const BoundaryPair& pair, const ManifoldScratch& scratch, const OverlapLoop& outer) {
  ContactManifold manifold;
  manifold.is_pierced = true;
  OverlapMoments moments{scratch.loop_points[outer.first_point].point, 0, {}};
  for_loops_of(scratch, outer, [&](const OverlapLoop& loop) { add_loop(moments, points_of(scratch, loop)); });
  add_holes_of_both(pair, scratch, outer, moments);
  if (!(moments.area > 0)) return manifold;
  const Point centroid = moments.origin + moments.first / moments.area;
  Vector gradient;    // R
  double turned = 0;  // B, about the centroid
  for_loops_of(scratch, outer, [&](const OverlapLoop& loop) {
    for (std::uint32_t s = loop.first; s < loop.first + loop.stretches; ++s) {
      const Vector enter = scratch.crossings[scratch.stretches[s].enter].point - centroid;
      const Vector leave = scratch.crossings[scratch.stretches[s].leave].point - centroid;
      gradient += leave - enter;
      turned += 0.5 * dot(leave - enter, leave + enter);
    }
  });
  manifold.area = moments.area;
  manifold.centroid = centroid;
  manifold.width = length(gradient);
  const Vector along = manifold.width > kNoWidth ? gradient / manifold.width : Vector{0, 1};
  manifold.normal = -perpendicular(along);
  Range off_line, on_line;
  double deepest = std::numeric_limits<double>::infinity();
  for (const OverlapPoint& p : points_of(scratch, outer)) {
    const Vector from_centroid = p.point - centroid;
    const double off = dot(from_centroid, manifold.normal);
    off_line.add(off);
    on_line.add(dot(from_centroid, along));
    manifold.reach = std::max(manifold.reach, length(from_centroid));
    if (p.edge_of_b == kNotOnB || off >= deepest) continue;
    deepest = off;
    manifold.tip_of_b = p.point;
    manifold.tip_edge_of_b = p.edge_of_b;
  }
  manifold.depth = off_line.extent();
  manifold.extent = std::max(manifold.depth, on_line.extent());
  // If the gradient is small, its line of action may lie far away, but crushing acts within the overlap.
  const double room = std::max(0.0, on_line.extent() - manifold.width);
  const double lever = manifold.width > kNoWidth ? turned / manifold.width : 0;
  const double low = on_line.low + 0.5 * (on_line.extent() - room);
  const Point middle = centroid + std::clamp(lever, low, low + room) * along;
  manifold.ends[0] = middle - 0.5 * manifold.width * along;
  manifold.ends[1] = middle + 0.5 * manifold.width * along;
  manifold.tip_of_a = middle;
  return manifold;
}

// ---- overlaps of one stretch of each boundary

/// The contribution of a chain of vertices to a manifold: the area between chain and contact line, and the largest
/// distance from the line.
struct ChainExtent {
  double area = 0;
  double depth = 0;
  Point tip;
  std::uint32_t tip_edge = 0;
  bool is_closed = false;  ///< the chain reached its end
};

/// A part of a boundary, from a point on one edge to a point on another or on the same edge.
struct Chain {
  const EdgeList& edges;
  std::uint32_t first = 0;  ///< edge of the first point
  Point from;
  std::uint32_t last = 0;  ///< edge of the last point
  Point to;
  bool wraps = false;  ///< true if it runs around the whole ring, when both points are on one edge
};

/// Walks along a chain and measures its distances from the contact line, which has this width, along `outward`. Writes
/// the chain's points as (along the line, off the line) into `profile`.
template <typename InFrame>
ChainExtent walk(const Chain& chain, double width, Vector outward, InFrame in_frame, std::vector<Point>& profile) {
  ChainExtent extent;
  extent.tip = midpoint(chain.from, chain.to);
  extent.tip_edge = chain.first;
  const Vector along = perpendicular(outward);
  profile.assign(1, {0, 0});
  Point previous = chain.from;
  extent.is_closed = for_vertices_between(chain.edges, chain.first, chain.last, chain.wraps, [&](std::uint32_t edge) {
    const Point vertex = in_frame(chain.edges.from(edge));
    extent.area += 0.5 * cross(previous - chain.from, vertex - chain.from);
    const double off = dot(vertex - chain.from, outward);
    profile.push_back({dot(vertex - chain.from, along), off});
    if (off > extent.depth) {
      extent.depth = off;
      extent.tip = vertex;
      extent.tip_edge = edge;
    }
    previous = vertex;
  });
  profile.push_back({width, 0});
  extent.area += 0.5 * cross(previous - chain.from, chain.to - chain.from);
  return extent;
}

/// Returns the largest distance of a profile from the line at a place along it.
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

/// Returns the largest thickness of the overlap across the contact line, which is at a vertex of either side. The
/// largest distances of the two sides cannot simply be added: two faces that are shifted along each other are farthest
/// at opposite ends of the line.
double thickness_of(const std::vector<Point>& a_side, const std::vector<Point>& b_side, double line) {
  // Limit on the product of the numbers of corners. Beyond it, which means that bodies lie deep in each other, the sum
  // of both distances is used instead of the thickness. It is too large if faces are shifted along each other. A larger
  // limit costs the product in every step.
  constexpr std::size_t kMostProduct = 4096;
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

/// A stretch of a's boundary inside b.
struct Stretch {
  const Crossing& enter;
  const Crossing& leave;
  bool closes_on_b = false;  ///< true if b's boundary leads from where it leaves to where it enters
};

/// Makes the manifold of a stretch. Returns false if its sides do not close.
bool make_manifold(const BoundaryPair& pair, const Stretch& stretch, ManifoldScratch& scratch,
                   ContactManifold& manifold) {
  const Crossing& enter = stretch.enter;
  const Crossing& leave = stretch.leave;
  const Vector line = leave.point - enter.point;
  manifold.width = length(line);
  if (manifold.width < kNoWidth) return false;
  manifold.normal = (-1 / manifold.width) * perpendicular(line);
  const auto as_is = [](Point p) { return p; };
  const auto from_b = [&](Point p) { return transform(pair.a_from_b, p); };
  const ChainExtent on_a = walk({pair.a.edges, enter.edge_a, enter.point, leave.edge_a, leave.point,
                                 enter.edge_a == leave.edge_a && !is_before(enter, leave, kOnA)},
                                manifold.width, manifold.normal, as_is, scratch.side_a);
  manifold.area = on_a.area;
  manifold.depth = on_a.depth;
  manifold.tip_of_a = on_a.tip;
  manifold.tip_of_b = midpoint(enter.point, leave.point);
  manifold.tip_edge_of_b = enter.edge_b;
  bool is_closed = on_a.is_closed;
  if (stretch.closes_on_b) {
    const ChainExtent on_b = walk({pair.b.edges, leave.edge_b, leave.point, enter.edge_b, enter.point,
                                   leave.edge_b == enter.edge_b && !is_before(leave, enter, kOnB)},
                                  manifold.width, -manifold.normal, from_b, scratch.side_b);
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

/// Appends the manifold of a stretch. Returns false if it has none.
bool add_manifold(const BoundaryPair& pair, const Stretch& stretch, ManifoldScratch& scratch,
                  std::vector<ContactManifold>& manifolds) {
  manifolds.emplace_back();
  if (make_manifold(pair, stretch, scratch, manifolds.back())) return true;
  manifolds.pop_back();
  return false;
}

/// Finds the manifolds of boundaries that cross more than twice.
int find_several(const BoundaryPair& pair, ManifoldScratch& scratch, std::vector<ContactManifold>& manifolds) {
  order_along(kOnA, pair.a.edges.ring, scratch.crossings);
  for (std::uint32_t i = 0; i < scratch.crossings.size(); ++i) scratch.crossings[i].place_on_a = i;
  scratch.by_b = scratch.crossings;
  order_along(kOnB, pair.b.edges.ring, scratch.by_b);
  trace_loops(pair.a, pair.b, scratch);
  measure_loops(pair, scratch);
  int left_out = 0;
  for (std::uint32_t i = 0; i < scratch.loops.size(); ++i) {
    const OverlapLoop& loop = scratch.loops[i];
    if (loop.outer != i) continue;
    if (loop.is_closed && (loop.stretches > 1 || loop.has_holes)) {
      manifolds.push_back(gradient_manifold(pair, scratch, loop));
      if (!(manifolds.back().area > 0)) manifolds.pop_back();
      continue;
    }
    for (std::uint32_t s = loop.first; s < loop.first + loop.stretches; ++s) {
      const Crossing& enter = scratch.crossings[scratch.stretches[s].enter];
      const Crossing& leave = scratch.crossings[scratch.stretches[s].leave];
      const bool is_left_out =
          leave.is_entering || !add_manifold(pair, {enter, leave, loop.is_closed}, scratch, manifolds);
      left_out += is_left_out ? 1 : 0;
      if (is_left_out || !loop.is_closed) continue;
      ContactManifold& manifold = manifolds.back();
      manifold.area = std::max(0.0, manifold.area - area_of_whole_holes(pair, scratch, loop));
    }
  }
  return left_out;
}

}  // namespace

int find_manifolds(const BoundaryPair& pair, const NearEdges& edges, ManifoldScratch& scratch,
                   std::vector<ContactManifold>& manifolds) {
  const std::vector<Crossing>& by_a = scratch.crossings;
  scratch.crossings.clear();
  find_crossings(pair.a_from_b, edges, scratch.crossings);
  if (by_a.empty()) return 0;
  const bool is_simple = by_a.size() == 2 && by_a[0].is_entering != by_a[1].is_entering && !pair.a.edges.has_holes() &&
                         !pair.b.edges.has_holes();
  if (is_simple) {  // nearly all contacts: no order is needed
    const bool is_first = by_a[0].is_entering;
    const Stretch stretch{by_a[is_first ? 0 : 1], by_a[is_first ? 1 : 0], true};
    return add_manifold(pair, stretch, scratch, manifolds) ? 0 : 1;
  }
  return find_several(pair, scratch, manifolds);
}

void find_circle_manifolds(const Covered& a, const Covered& b, const Pose& a_from_b,
                           const std::vector<NearPair>& circle_pairs, std::vector<ContactManifold>& manifolds) {
  for (const NearPair pair : circle_pairs) {
    const ContactCircle& ca = a.cover.circles[pair.a];
    const ContactCircle& cb = b.cover.circles[pair.b];
    const Vector line = transform(a_from_b, cb.centre) - ca.centre;
    const double centres = length(line);
    const double depth = ca.radius + cb.radius - centres;
    if (depth <= 0 || centres == 0) continue;
    ContactManifold manifold;
    manifold.normal = line / centres;
    manifold.depth = depth;
    // Half of the lens's chord: c² = r_a² − x², with the distance x of the chord from a's centre.
    const double x = (centres * centres + ca.radius * ca.radius - cb.radius * cb.radius) / (2 * centres);
    const double half_chord = std::sqrt(std::max(0.0, ca.radius * ca.radius - x * x));
    const Point middle = ca.centre + (ca.radius - 0.5 * depth) * manifold.normal;
    manifold.width = 2 * half_chord;
    manifold.area = 2.0 / 3.0 * depth * manifold.width;  // of a thin lens
    manifold.ends[0] = middle - half_chord * perpendicular(manifold.normal);
    manifold.ends[1] = middle + half_chord * perpendicular(manifold.normal);
    manifold.tip_of_a = middle;
    manifold.tip_of_b = ca.centre + (centres - cb.radius) * manifold.normal;
    manifold.tip_edge_of_b = b.cover.pieces[pair.b].first_edge;
    manifolds.push_back(manifold);
  }
}

}  // namespace polynya::geometry
