#include "geometry/contact/manifolds.hpp"

#include <algorithm>
#include <cmath>

namespace polynya::geometry {
namespace {

using Crossing = ManifoldScratch::Crossing;

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
ChainExtent walk(const EdgeList& edges, std::uint32_t first, Point from, std::uint32_t last, Point to, double width,
                 Vector outward, bool wraps, InFrame in_frame, std::vector<Point>& profile) {
  ChainExtent extent;
  extent.tip = midpoint(from, to);
  extent.tip_edge = first;
  const Vector along = perpendicular(outward);
  profile.clear();
  profile.push_back({0, 0});
  Point previous = from;
  std::uint32_t edge = first;
  for (std::size_t left = edges.size(); left > 0 && (edge != last || wraps); --left) {
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
  // Of the sides' corners. Beyond, the sum of both extents stands for the thickness, which is too large where
  // faces are shifted along each other: bodies that lie deep in each other. More costs the product, in every
  // step.
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

/// The manifold of one stretch of a's boundary inside b, from its entering to its leaving crossing; false
/// where its sides do not close.
bool make_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b, const Crossing& enter,
                   const Crossing& leave, bool closes_on_b, ManifoldScratch& scratch, ContactManifold& manifold) {
  const Vector line = leave.point - enter.point;
  manifold.width = length(line);
  if (manifold.width < kNoWidth) return false;
  manifold.normal = (-1 / manifold.width) * perpendicular(line);
  const auto as_is = [](Point p) { return p; };
  const auto from_b = [&](Point p) { return transform(a_from_b, p); };
  const ChainExtent on_a =
      walk(a.edges, enter.edge_a, enter.point, leave.edge_a, leave.point, manifold.width, manifold.normal,
           enter.edge_a == leave.edge_a && !is_before_on_a(enter, leave), as_is, scratch.side_a);
  manifold.area = on_a.area;
  manifold.depth = on_a.depth;
  manifold.tip_of_a = on_a.tip;
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

/// Appends the manifold of a stretch, where it has one.
bool add_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b, const Crossing& enter,
                  const Crossing& leave, bool closes_on_b, ManifoldScratch& scratch,
                  std::vector<ContactManifold>& manifolds) {
  manifolds.emplace_back();
  if (make_manifold(a, b, a_from_b, enter, leave, closes_on_b, scratch, manifolds.back())) return true;
  manifolds.pop_back();
  return false;
}

/// The manifolds of boundaries that cross more than twice.
int find_several(const Boundary& a, const Boundary& b, const Pose& a_from_b, ManifoldScratch& scratch,
                 std::vector<ContactManifold>& manifolds) {
  order_crossings(a, b, scratch);
  trace_loops(a, b, scratch);
  measure_loops(a, b, a_from_b, scratch);
  int left_out = 0;
  for (std::uint32_t i = 0; i < scratch.loops.size(); ++i) {
    const OverlapLoop& loop = scratch.loops[i];
    if (loop.outer != i) continue;
    if (loop.is_closed && (loop.stretches > 1 || loop.has_holes)) {
      manifolds.push_back(gradient_manifold(a, b, a_from_b, scratch, loop));
      if (!(manifolds.back().area > 0)) manifolds.pop_back();
      continue;
    }
    for (std::uint32_t s = loop.first; s < loop.first + loop.stretches; ++s) {
      const Crossing& enter = scratch.crossings[scratch.stretches[s].enter];
      const Crossing& leave = scratch.crossings[scratch.stretches[s].leave];
      const bool is_left_out =
          leave.is_entering || !add_manifold(a, b, a_from_b, enter, leave, loop.is_closed, scratch, manifolds);
      left_out += is_left_out ? 1 : 0;
      if (is_left_out || !loop.is_closed) continue;
      ContactManifold& manifold = manifolds.back();
      manifold.area = std::max(0.0, manifold.area - area_of_whole_holes(a, b, a_from_b, scratch, loop));
    }
  }
  return left_out;
}

}  // namespace

int find_manifolds(const Boundary& a, const Boundary& b, const Pose& a_from_b, const NearEdges& edges,
                   ManifoldScratch& scratch, std::vector<ContactManifold>& manifolds) {
  const std::vector<Crossing>& by_a = scratch.crossings;
  scratch.crossings.clear();
  find_crossings(a_from_b, edges, scratch.crossings);
  if (by_a.empty()) return 0;
  const bool is_simple =
      by_a.size() == 2 && by_a[0].is_entering != by_a[1].is_entering && !a.edges.has_holes() && !b.edges.has_holes();
  if (is_simple) {  // nearly all contacts: no order to find
    const bool is_first = by_a[0].is_entering;
    return !add_manifold(a, b, a_from_b, by_a[is_first ? 0 : 1], by_a[is_first ? 1 : 0], true, scratch, manifolds) ? 1
                                                                                                                   : 0;
  }
  return find_several(a, b, a_from_b, scratch, manifolds);
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
    // Half the lens's chord: c² = r_a² − x², with x the chord's distance from a's centre.
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
