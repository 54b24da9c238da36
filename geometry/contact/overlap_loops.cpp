#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "geometry/contact/manifolds.hpp"
#include "geometry/exact/point_in_ring.hpp"

namespace polynya::geometry {
namespace {

using Crossing = ManifoldScratch::Crossing;

/// Writes the vertices after a point on edge `first` up to one on edge `last`. `wraps`: all around the ring,
/// where both are on one edge.
template <typename Use>
void for_vertices_between(const EdgeList& edges, std::uint32_t first, std::uint32_t last, bool wraps, Use use) {
  std::size_t left = edges.size();
  for (std::uint32_t edge = first; (edge != last || wraps) && left > 0; --left) {
    wraps = false;
    edge = edges.next[edge];
    use(edge);
  }
}

void write_points(const Boundary& a, const Boundary& b, const Pose& a_from_b, ManifoldScratch& scratch,
                  OverlapLoop& loop) {
  std::vector<OverlapPoint>& points = scratch.loop_points;
  loop.first_point = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t s = loop.first; s < loop.first + loop.stretches; ++s) {
    const OverlapStretch& stretch = scratch.stretches[s];
    const Crossing& enter = scratch.crossings[stretch.enter];
    const Crossing& leave = scratch.crossings[stretch.leave];
    const Crossing& next = scratch.crossings[stretch.next];
    // Where two crossings are on one edge, their order decides, not their places: these may be the same.
    const bool wraps_a = enter.edge_a == leave.edge_a && stretch.leave < stretch.enter;
    const bool wraps_b =
        leave.edge_b == next.edge_b && scratch.place_on_b[stretch.next] < scratch.place_on_b[stretch.leave];
    points.push_back({enter.point, enter.edge_b});
    for_vertices_between(a.edges, enter.edge_a, leave.edge_a, wraps_a, [&](std::uint32_t edge) {
      points.push_back({a.edges.from(edge), kNotOnB});
    });
    points.push_back({leave.point, leave.edge_b});
    for_vertices_between(b.edges, leave.edge_b, next.edge_b, wraps_b, [&](std::uint32_t edge) {
      points.push_back({transform(a_from_b, b.edges.from(edge)), edge});
    });
  }
  loop.points = static_cast<std::uint32_t>(points.size()) - loop.first_point;
}

/// Area, and its first moments about an origin.
struct Moments {
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

void add_loop(Moments& moments, std::span<const OverlapPoint> points) {
  for (std::size_t i = 0; i < points.size(); ++i)
    moments.add_edge(points[i].point, points[i + 1 < points.size() ? i + 1 : 0].point);
}

bool is_inside(std::span<const OverlapPoint> points, Point p) {
  bool inside = false;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (crosses_ray(points[i].point, points[i + 1 < points.size() ? i + 1 : 0].point, p)) inside = !inside;
  }
  return inside;
}

bool is_hole_of(const ManifoldScratch& scratch, std::size_t hole, std::size_t outer) {
  return scratch.loops[outer].area > 0 &&
         is_inside(points_of(scratch, scratch.loops[outer]), points_of(scratch, scratch.loops[hole])[0].point);
}

/// Takes out of an overlap the holes of one body that lie in it whole, without a crossing.
template <typename InFrame, typename IsCrossed>
void add_whole_holes(const EdgeList& edges, InFrame in_frame, IsCrossed is_crossed, std::span<const OverlapPoint> outer,
                     Moments& moments) {
  std::size_t end = 0;
  for (std::size_t first = 0; first < edges.size(); first = end) {
    const std::uint32_t ring = edges.ring[first];
    for (end = first; end < edges.size() && edges.ring[end] == ring;) ++end;
    if (ring == 0 || is_crossed(ring) || !is_inside(outer, in_frame(edges.vertices[first]))) continue;
    for (auto edge = static_cast<std::uint32_t>(first); edge < end; ++edge)
      moments.add_edge(in_frame(edges.from(edge)), in_frame(edges.to(edge)));
  }
}

void add_holes_of_both(const Boundary& a, const Boundary& b, const Pose& a_from_b, const ManifoldScratch& scratch,
                       const OverlapLoop& loop, Moments& moments) {
  const auto points = points_of(scratch, loop);
  const auto crosses = [&](const Boundary& body, std::uint32_t Crossing::*edge) {
    return [&scratch, &body, edge](std::uint32_t ring) {
      return std::ranges::any_of(scratch.crossings,
                                 [&](const Crossing& c) { return body.edges.ring[c.*edge] == ring; });
    };
  };
  add_whole_holes(
      a.edges, [](Point p) { return p; }, crosses(a, &Crossing::edge_a), points, moments);
  add_whole_holes(
      b.edges, [&](Point p) { return transform(a_from_b, p); }, crosses(b, &Crossing::edge_b), points, moments);
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

}  // namespace

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
      const auto leave = static_cast<std::uint32_t>(next_on_ring(by_a, enter, a.edges.ring, &Crossing::edge_a));
      const std::size_t next_on_b = next_on_ring(by_b, scratch.place_on_b[leave], b.edges.ring, &Crossing::edge_b);
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

void measure_loops(const Boundary& a, const Boundary& b, const Pose& a_from_b, ManifoldScratch& scratch) {
  const bool has_holes = a.edges.has_holes() || b.edges.has_holes();
  scratch.loop_points.clear();
  for (OverlapLoop& loop : scratch.loops) {
    if (!loop.is_closed || (loop.stretches == 1 && !has_holes)) continue;
    write_points(a, b, a_from_b, scratch, loop);
    Moments moments{scratch.loop_points[loop.first_point].point, 0, {}};
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

double area_of_whole_holes(const Boundary& a, const Boundary& b, const Pose& a_from_b, const ManifoldScratch& scratch,
                           const OverlapLoop& loop) {
  if (loop.points == 0) return 0;  // no body has holes
  Moments moments{scratch.loop_points[loop.first_point].point, 0, {}};
  add_holes_of_both(a, b, a_from_b, scratch, loop, moments);
  return -moments.area;
}

ContactManifold gradient_manifold(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                                  const ManifoldScratch& scratch, const OverlapLoop& outer) {
  ContactManifold manifold;
  manifold.is_pierced = true;
  Moments moments{scratch.loop_points[outer.first_point].point, 0, {}};
  for_loops_of(scratch, outer, [&](const OverlapLoop& loop) { add_loop(moments, points_of(scratch, loop)); });
  add_holes_of_both(a, b, a_from_b, scratch, outer, moments);
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
  // Where the gradient is small its line of action may lie far off: crushing acts within the overlap.
  const double room = std::max(0.0, on_line.extent() - manifold.width);
  const double lever = manifold.width > kNoWidth ? turned / manifold.width : 0;
  const double low = on_line.low + 0.5 * (on_line.extent() - room);
  const Point middle = centroid + std::clamp(lever, low, low + room) * along;
  manifold.ends[0] = middle - 0.5 * manifold.width * along;
  manifold.ends[1] = middle + 0.5 * manifold.width * along;
  manifold.tip_of_a = middle;
  return manifold;
}

}  // namespace polynya::geometry
