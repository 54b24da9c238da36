#include <algorithm>
#include <cmath>

#include "geometry/boundary.hpp"

namespace polynya::geometry {
namespace {

using Crossing = PatchScratch::Crossing;

// Which side of edge (p, q) point r is on, true for left. A zero is decided as if all of b were moved by (ε,
// ε²), ε → 0: the same tie-break on both boundaries makes crossings alternate between entering and leaving.
bool is_left_of_a_edge(Point p, Point q, Point r_of_b) {
  const double turn = cross(q - p, r_of_b - p);
  if (turn != 0) return turn > 0;
  const Vector d = q - p;
  return d.y != 0 ? d.y < 0 : d.x > 0;
}
bool is_left_of_b_edge(Point p, Point q, Point r_of_a) {
  const double turn = cross(q - p, r_of_a - p);
  if (turn != 0) return turn > 0;
  const Vector d = q - p;
  return d.y != 0 ? d.y > 0 : d.x < 0;
}

void find_crossings(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                    const std::vector<NearPair>& edge_pairs, std::vector<Crossing>& crossings) {
  for (const NearPair pair : edge_pairs) {
    const Point a0 = a.edges.from(pair.a);
    const Point a1 = a.edges.to(pair.a);
    const Point b0 = point_in_world(a_from_b, b.edges.from(pair.b));
    const Point b1 = point_in_world(a_from_b, b.edges.to(pair.b));
    if (is_left_of_a_edge(a0, a1, b0) == is_left_of_a_edge(a0, a1, b1)) continue;
    const bool starts_inside = is_left_of_b_edge(b0, b1, a0);
    if (starts_inside == is_left_of_b_edge(b0, b1, a1)) continue;
    const double turn = cross(a1 - a0, b1 - b0);
    const double along_a = turn != 0 ? std::clamp(cross(b0 - a0, b1 - b0) / turn, 0.0, 1.0) : 0.5;
    const double along_b = turn != 0 ? std::clamp(cross(b0 - a0, a1 - a0) / turn, 0.0, 1.0) : 0.5;
    crossings.push_back({a0 + along_a * (a1 - a0), pair.a, pair.b, along_a, along_b, !starts_inside});
  }
}

bool is_before_on_a(const Crossing& p, const Crossing& q) {
  return p.edge_a != q.edge_a ? p.edge_a < q.edge_a : p.along_a < q.along_a;
}
bool is_before_on_b(const Crossing& p, const Crossing& q) {
  return p.edge_b != q.edge_b ? p.edge_b < q.edge_b : p.along_b < q.along_b;
}

/// What a chain of vertices adds to a patch: area between chain and contact line, and how far it reaches off
/// it.
struct ChainExtent {
  double area = 0;
  double depth = 0;
  Point tip;
  std::uint32_t tip_edge = 0;
  bool is_closed = false;  ///< the chain did arrive
};

/// Walks `edges` from a point on edge `first` to a point on edge `last`, measuring along `outward` from the
/// line.
template <typename InFrame>
ChainExtent walk(const EdgeList& edges, std::uint32_t first, Point from, std::uint32_t last, Point to,
                 Vector outward, bool wraps, InFrame in_frame) {
  constexpr int kMostVertices = 4096;  // a stretch this long is no contact: the bodies stand in each other
  ChainExtent extent;
  extent.tip = midpoint(from, to);
  extent.tip_edge = first;
  Point previous = from;
  std::uint32_t edge = first;
  for (int k = 0; k < kMostVertices && (edge != last || wraps); ++k) {
    wraps = false;
    edge = edges.next[edge];
    const Point vertex = in_frame(edges.from(edge));
    extent.area += 0.5 * cross(previous - from, vertex - from);
    const double off = dot(vertex - from, outward);
    if (off > extent.depth) {
      extent.depth = off;
      extent.tip = vertex;
      extent.tip_edge = edge;
    }
    previous = vertex;
  }
  extent.area += 0.5 * cross(previous - from, to - from);
  extent.is_closed = edge == last;
  return extent;
}

}  // namespace

int find_patches(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                 const std::vector<NearPair>& edge_pairs, PatchScratch& scratch,
                 std::vector<ContactPatch>& patches) {
  std::vector<Crossing>& crossings = scratch.crossings;
  crossings.clear();
  find_crossings(a, b, a_from_b, edge_pairs, crossings);
  if (crossings.empty()) return 0;
  std::sort(crossings.begin(), crossings.end(), is_before_on_a);
  scratch.order_b.resize(crossings.size());
  for (std::uint32_t i = 0; i < crossings.size(); ++i) scratch.order_b[i] = i;
  std::sort(scratch.order_b.begin(), scratch.order_b.end(),
            [&](std::uint32_t p, std::uint32_t q) { return is_before_on_b(crossings[p], crossings[q]); });

  const auto next_on_a = [&](std::size_t i) -> std::size_t {
    const std::uint32_t ring = a.edges.ring[crossings[i].edge_a];
    if (i + 1 < crossings.size() && a.edges.ring[crossings[i + 1].edge_a] == ring) return i + 1;
    while (i > 0 && a.edges.ring[crossings[i - 1].edge_a] == ring) --i;
    return i;
  };
  const auto& order = scratch.order_b;
  const auto next_on_b = [&](std::size_t i) -> std::size_t {
    auto at = static_cast<std::size_t>(std::find(order.begin(), order.end(), i) - order.begin());
    const std::uint32_t ring = b.edges.ring[crossings[i].edge_b];
    if (at + 1 < order.size() && b.edges.ring[crossings[order[at + 1]].edge_b] == ring) return order[at + 1];
    while (at > 0 && b.edges.ring[crossings[order[at - 1]].edge_b] == ring) --at;
    return order[at];
  };

  int left_out = 0;
  for (std::size_t i = 0; i < crossings.size(); ++i) {
    if (!crossings[i].is_entering) continue;
    const Crossing& enter = crossings[i];
    const std::size_t j = next_on_a(i);
    const Crossing& leave = crossings[j];
    const Vector line = leave.point - enter.point;
    const double width = length(line);
    if (j == i || leave.is_entering || width < 1e-12) {
      ++left_out;
      continue;
    }
    ContactPatch patch;
    patch.normal = -perpendicular(line) / width;
    const auto as_is = [](Point p) { return p; };
    const auto from_b = [&](Point p) { return point_in_world(a_from_b, p); };
    const ChainExtent on_a = walk(a.edges, enter.edge_a, enter.point, leave.edge_a, leave.point, patch.normal,
                                  enter.edge_a == leave.edge_a && !is_before_on_a(enter, leave), as_is);
    bool is_closed = on_a.is_closed;
    patch.area = on_a.area;
    patch.depth = on_a.depth;
    patch.tip_of_b = midpoint(enter.point, leave.point);
    patch.tip_edge_of_b = enter.edge_b;
    if (next_on_b(j) == i) {
      const ChainExtent on_b =
          walk(b.edges, leave.edge_b, leave.point, enter.edge_b, enter.point, -patch.normal,
               leave.edge_b == enter.edge_b && !is_before_on_b(leave, enter), from_b);
      patch.area += on_b.area;
      patch.depth += on_b.depth;
      if (on_b.depth > 0) {
        patch.tip_of_b = on_b.tip;
        patch.tip_edge_of_b = on_b.tip_edge;
      }
      is_closed = is_closed && on_b.is_closed;
    }
    if (!is_closed) {
      ++left_out;
      continue;
    }
    patch.ends[0] = enter.point;
    patch.ends[1] = leave.point;
    patch.width = width;
    patch.area = std::max(patch.area, 0.0);
    patch.edge_of_a = enter.edge_a;
    patch.edge_of_b = enter.edge_b;
    patches.push_back(patch);
  }
  return left_out;
}

void find_circle_patches(const Boundary& a, const Boundary& b, const Pose& a_from_b,
                         const std::vector<NearPair>& circle_pairs, std::vector<ContactPatch>& patches) {
  for (const NearPair pair : circle_pairs) {
    const ContactCircle& ca = a.circles[pair.a];
    const ContactCircle& cb = b.circles[pair.b];
    const Vector line = point_in_world(a_from_b, cb.centre) - ca.centre;
    const double centres = length(line);
    const double depth = ca.radius + cb.radius - centres;
    if (depth <= 0 || centres == 0) continue;
    ContactPatch patch;
    patch.normal = line / centres;
    patch.depth = depth;
    // Half the lens's chord: c² = r_a² − x², with x the chord's distance from a's centre.
    const double x = (centres * centres + ca.radius * ca.radius - cb.radius * cb.radius) / (2 * centres);
    const double half_chord = std::sqrt(std::max(0.0, ca.radius * ca.radius - x * x));
    const Point middle = ca.centre + (ca.radius - 0.5 * depth) * patch.normal;
    patch.width = 2 * half_chord;
    patch.area = 2.0 / 3.0 * depth * patch.width;  // of a thin lens
    patch.ends[0] = middle - half_chord * perpendicular(patch.normal);
    patch.ends[1] = middle + half_chord * perpendicular(patch.normal);
    patch.tip_of_b = ca.centre + (centres - cb.radius) * patch.normal;
    patch.edge_of_a = ca.first_edge;
    patch.edge_of_b = patch.tip_edge_of_b = cb.first_edge;
    patches.push_back(patch);
  }
}

}  // namespace polynya::geometry
