#include "geometry/contact/contact_circles.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/shape/box_tree.hpp"

namespace polynya::geometry {
namespace {

/// The largest circle up to `radius` that touches the boundary at `touch` from inside and holds no boundary
/// point: shrink the circle onto the nearest boundary point inside it until there is none.
double inscribed_radius(const EdgeList& edges, const BoxTree& tree, Point touch, Vector inward, double radius) {
  constexpr int kMostShrinks = 64;  // a few are the rule; very sharp corners took up to twenty
  for (int shrink = 0; shrink < kMostShrinks; ++shrink) {
    const Point centre = touch + radius * inward;
    const double inside = radius * (1 - 1e-9);
    double nearest = inside * inside;
    Point intruder;
    bool is_free = true;
    tree.for_each_near(grown({centre, centre}, radius), [&](std::size_t i) {
      const auto e = static_cast<std::uint32_t>(i);
      const Point q = nearest_on_segment(edges.from(e), edges.to(e), centre);
      const double d = squared_length(q - centre);
      // A point level with the touching point lies on its own edge: no smaller circle avoids it.
      if (d < nearest && dot(q - touch, inward) > 1e-12 * radius) {
        nearest = d;
        intruder = q;
        is_free = false;
      }
      return true;
    });
    if (is_free) break;
    radius = squared_length(intruder - touch) / (2 * dot(intruder - touch, inward));
  }
  return radius;
}

/// Sets the middle and the reach of a run of whole edges of these lengths, and of this length in all [m].
void measure_run(const EdgeList& edges, const std::vector<double>& lengths, BoundaryPiece& piece, double total) {
  double before = 0;
  std::uint32_t e = piece.first_edge;
  for (std::uint32_t k = 0; k < piece.edges; ++k, e = edges.next[e]) {
    const double l = lengths[e];
    if (before + l < 0.5 * total && k + 1 < piece.edges) {
      before += l;
      continue;
    }
    const double t = std::clamp((0.5 * total - before) / l, 0.0, 1.0);
    piece.middle = edges.from(e) + t * (edges.to(e) - edges.from(e));
    piece.middle_edge = e;
    break;
  }
  piece.reach = 0.5 * total * (1 + 1e-12);  // no chord is longer than its way
}

/// How far the piece goes from a point on the perpendicular of its middle [m].
double reach_from(const EdgeList& edges, const BoundaryPiece& piece, Point centre) {
  if (piece.edges == 1) return std::hypot(distance(centre, piece.middle), piece.reach);
  std::uint32_t e = piece.first_edge;
  double reach = distance(centre, edges.from(e));
  for (std::uint32_t k = 0; k < piece.edges; ++k, e = edges.next[e])
    reach = std::max(reach, distance(centre, edges.to(e)));
  return reach;
}

ContactCircle circle_for(const EdgeList& edges, const BoxTree& tree, const BoundaryPiece& piece, double radius) {
  const Vector along = edges.to(piece.middle_edge) - edges.from(piece.middle_edge);
  const Vector inward = perpendicular(along) / length(along);
  ContactCircle circle;
  circle.radius = inscribed_radius(edges, tree, piece.middle, inward, radius);
  circle.centre = piece.middle + circle.radius * inward;
  circle.reach = reach_from(edges, piece, circle.centre) * (1 + 1e-12);  // the rounding of the distances
  return circle;
}

}  // namespace

EdgeList edge_list(const Polygon& polygon) {
  EdgeList edges;
  edges.vertices.reserve(vertex_count(polygon));
  edges.next.reserve(vertex_count(polygon));
  edges.ring.reserve(vertex_count(polygon));
  const auto add = [&](const Ring& ring, std::uint32_t number) {
    const auto first = static_cast<std::uint32_t>(edges.vertices.size());
    for (std::size_t i = 0; i < ring.size(); ++i) {
      edges.vertices.push_back(ring[i]);
      edges.next.push_back(i + 1 < ring.size() ? first + static_cast<std::uint32_t>(i) + 1 : first);
      edges.ring.push_back(number);
    }
  };
  add(polygon.outer, 0);
  for (std::uint32_t i = 0; i < polygon.holes.size(); ++i) add(polygon.holes[i], i + 1);
  return edges;
}

std::vector<BoundaryPiece> boundary_pieces(const EdgeList& edges, double radius, double most) {
  const auto count = static_cast<std::uint32_t>(edges.size());
  std::vector<double> lengths(count);
  double total_length = 0;
  for (std::uint32_t e = 0; e < count; ++e) total_length += lengths[e] = distance(edges.from(e), edges.to(e));
  std::vector<BoundaryPiece> pieces;
  pieces.reserve(static_cast<std::size_t>(std::min<double>(count, 2 * total_length / radius)) + 1);
  for (std::uint32_t e = 0; e < count; ++e) {
    const double l = lengths[e];
    if (l > radius) {  // a long edge carries several
      const double parts = std::min(std::ceil(l / radius), most);
      const Vector step = (edges.to(e) - edges.from(e)) / parts;
      const double reach = 0.5 * l / parts * (1 + 1e-12);
      for (int k = 0; k < static_cast<int>(parts); ++k)
        pieces.push_back({edges.from(e) + (k + 0.5) * step, reach, e, 1, e});
      continue;
    }
    BoundaryPiece piece{{}, 0, e, 1, e};  // short edges share one
    double total = l;
    while (edges.next[e] == e + 1) {
      const double more = lengths[e + 1];
      if (total + more > radius) break;
      ++e;
      ++piece.edges;
      total += more;
    }
    measure_run(edges, lengths, piece, total);
    pieces.push_back(piece);
  }
  return pieces;
}

std::vector<ContactCircle> sample_contact_circles(const EdgeList& edges, const std::vector<BoundaryPiece>& pieces,
                                                  double radius) {
  std::vector<ContactCircle> circles;
  circles.reserve(pieces.size());
  std::vector<Box> boxes;
  boxes.reserve(edges.size());
  for (std::uint32_t e = 0; e < edges.size(); ++e) boxes.push_back(box_around(edges.from(e), edges.to(e)));
  const BoxTree tree(std::move(boxes));
  for (const BoundaryPiece& piece : pieces) circles.push_back(circle_for(edges, tree, piece, radius));
  return circles;
}

}  // namespace polynya::geometry
