#include "geometry/contact/boundary.hpp"

#include <array>
#include <cmath>

#include "elementary/elementary.hpp"
#include "geometry/exact/predicates.hpp"
#include "geometry/shape/box_tree.hpp"
#include "geometry/shape/segments.hpp"

namespace polynya::geometry {
namespace {

/// Returns the radius of the largest circle, up to `radius`, that touches the boundary at `touch` from inside and
/// contains no boundary point. The circle is shrunk onto the nearest boundary point inside it until there is none.
double inscribed_radius(const EdgeList& edges, const BoxTree& tree, Point touch, Vector inward, double radius) {
  constexpr int kMostShrinks = 64;  // a few are usual; very sharp corners took up to twenty
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
      // A point level with the touching point lies on the same edge: a smaller circle does not avoid it.
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

/// Sets the middle and the reach of a run of whole edges with these lengths and this total length [m].
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
  piece.reach = 0.5 * total * (1 + 1e-12);  // no chord is longer than its path
}

/// Returns the largest distance of the piece from a point on the perpendicular of its middle [m].
double reach_from(const EdgeList& edges, const BoundaryPiece& piece, Point centre) {
  if (piece.edges == 1) return elementary::hypot(distance(centre, piece.middle), piece.reach);
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
  circle.reach = reach_from(edges, piece, circle.centre) * (1 + 1e-12);  // a margin for the rounding of the distances
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
    if (l > radius) {  // a long edge has several pieces
      const double parts = std::min(std::ceil(l / radius), most);
      const Vector step = (edges.to(e) - edges.from(e)) / parts;
      const double reach = 0.5 * l / parts * (1 + 1e-12);
      for (int k = 0; k < static_cast<int>(parts); ++k)
        pieces.push_back({{e, 1}, edges.from(e) + (k + 0.5) * step, reach, e});
      continue;
    }
    BoundaryPiece piece{{e, 1}, {}, 0, e};  // short edges share one piece
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

// ---- covers

namespace {

/// Number of bounding circles in a leaf. More: they are compared one by one. Fewer: the tree is larger.
constexpr std::uint32_t kLeafCircles = 4;
/// Largest number of pieces of an edge: one for each metre of a ship's side, but not of a plate's. More: more memory,
/// 64 bytes each. Fewer: larger parts of a long edge count as near, and contacts are found more slowly.
constexpr double kMostPieces = 128;

/// Centres and radii of some bounding circles.
struct Extent {
  Box centres;
  double reach = 0;  ///< largest radius
};

/// Returns the smallest reach of a leaf that covers its circles, or of another node that covers its children's.
double covering_reach(const Cover& cover, std::size_t index, const CircleNode& node) {
  double reach = 0;
  const auto include = [&](const auto& circle) {
    reach = std::max(reach, distance(node.centre, circle.centre) + circle.reach);
  };
  if (node.right == 0) {
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) include(cover.bounding_circles[i]);
  } else {
    include(cover.tree[index + 1]);
    include(cover.tree[node.right]);
  }
  return reach;
}

/// Builds the node over bounding circles [first, first + count) and everything below it.
Extent build_node(Cover& cover, std::uint32_t first, std::uint32_t count) {
  const std::size_t index = cover.tree.size();
  cover.tree.push_back({});
  CircleNode node{{}, 0, first, count, 0};
  Extent extent{{cover.bounding_circles[first].centre, cover.bounding_circles[first].centre}, 0};
  if (count > kLeafCircles) {
    extent = build_node(cover, first, count / 2);
    node.right = static_cast<std::uint32_t>(cover.tree.size());
    const Extent other = build_node(cover, first + count / 2, count - count / 2);
    extend(extent.centres, other.centres);
    extent.reach = std::max(extent.reach, other.reach);
  } else {
    for (std::uint32_t i = first; i < first + count; ++i) {
      extend(extent.centres, cover.bounding_circles[i].centre);
      extent.reach = std::max(extent.reach, cover.bounding_circles[i].reach);
    }
  }
  node.centre = midpoint(extent.centres.low, extent.centres.high);
  node.reach = std::min(covering_reach(cover, index, node), distance(node.centre, extent.centres.high) + extent.reach);
  node.reach *= 1 + 1e-12;
  cover.tree[index] = node;
  return extent;
}

}  // namespace

Boundary make_outline(const Polygon& polygon) {
  Boundary boundary;
  boundary.edges = edge_list(polygon);
  return boundary;
}

double pieces_of(const EdgeList& edges, double circle_radius) {
  double length = 0;
  for (std::uint32_t e = 0; e < edges.size(); ++e) length += distance(edges.from(e), edges.to(e));
  return 1 + length / circle_radius;
}

void make_cover(const EdgeList& edges, const CircleRule& rule, Cover& cover) {
  // Contact circles have their given size. Circles that only bound may be coarse where a plate's rim is long and
  // straight.
  const std::vector<BoundaryPiece> pieces = rule.has_circles ? boundary_pieces(edges, rule.circle_radius)
                                                             : boundary_pieces(edges, rule.circle_radius, kMostPieces);
  cover.pieces.assign(pieces.begin(), pieces.end());
  cover.bounding_circles.clear();
  cover.bounding_circles.reserve(pieces.size());
  if (rule.has_circles) {
    cover.circles = sample_contact_circles(edges, pieces, rule.circle_radius);
    for (const ContactCircle& circle : cover.circles) cover.bounding_circles.push_back({circle.centre, circle.reach});
  } else {
    for (const BoundaryPiece& piece : pieces) cover.bounding_circles.push_back({piece.middle, piece.reach});
  }
  cover.tree.clear();
  cover.tree.reserve(pieces.size());
  build_node(cover, 0, static_cast<std::uint32_t>(pieces.size()));
}

void make_ready(Boundary& boundary, const CircleRule& rule) {
  auto cover = std::make_shared<Cover>();
  make_cover(boundary.edges, rule, *cover);
  cover->tree.shrink_to_fit();
  boundary.cover = std::move(cover);
}

bool is_inside(const EdgeList& edges, Point p) {
  bool inside = false;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    if (crosses_ray(edges.from(edge), edges.to(edge), p)) inside = !inside;
  }
  return inside;
}

}  // namespace polynya::geometry
