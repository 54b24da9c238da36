#include "geometry/contact/boundary.hpp"

#include <array>
#include <cmath>

#include "elementary/elementary.hpp"

#include "geometry/exact/predicates.hpp"
#include "geometry/shape/box_tree.hpp"
#include "geometry/shape/segments.hpp"

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
        pieces.push_back({{e, 1}, edges.from(e) + (k + 0.5) * step, reach, e});
      continue;
    }
    BoundaryPiece piece{{e, 1}, {}, 0, e};  // short edges share one
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

/// Bounding circles of a leaf. More are compared one by one, fewer make a larger tree.
constexpr std::uint32_t kLeafCircles = 4;
/// Pieces of an edge: every metre of a ship's side, not of a plate's. More take memory, 64 bytes each; fewer
/// make more of a long edge near, and contacts slower.
constexpr double kMostPieces = 128;

/// Centres and radii of some bounding circles.
struct Extent {
  Box centres;
  double reach = 0;  ///< the largest
};

/// The least reach of a leaf that covers its circles, or of another node that covers its children's.
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

double gap(const CircleNode& a, const CircleNode& b, Point b_centre_in_a) {
  return distance(a.centre, b_centre_in_a) - a.reach - b.reach;
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
  // Contact circles have their size; what only bounds may be coarse where a plate's rim is long and straight.
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

double near_circles(const Covered& a, const Covered& b, const Pose& a_from_b, double margin,
                    std::vector<NearPair>& circle_pairs) {
  double bound = std::numeric_limits<double>::infinity();
  const std::size_t before = circle_pairs.size();
  NearPair stack[128];  // depth of both trees: a boundary of 2^60 circles would fit
  int top = 0;
  stack[top++] = {0, 0};
  while (top > 0) {
    const NearPair pair = stack[--top];
    const CircleNode& na = a.cover.tree[pair.a];
    const CircleNode& nb = b.cover.tree[pair.b];
    const double d = gap(na, nb, transform(a_from_b, nb.centre));
    if (d > margin) {
      bound = std::min(bound, d);
      continue;
    }
    if (na.right == 0 && nb.right == 0) {
      for (std::uint32_t k = nb.first; k < nb.first + nb.count; ++k) {
        const BoundingCircle& of_b = b.cover.bounding_circles[k];
        const Point centre = transform(a_from_b, of_b.centre);
        for (std::uint32_t i = na.first; i < na.first + na.count; ++i) {
          const BoundingCircle& of_a = a.cover.bounding_circles[i];
          const double reaches = of_a.reach + of_b.reach;
          const double squared = squared_length(centre - of_a.centre);
          if (squared <= (reaches + margin) * (reaches + margin))
            circle_pairs.push_back({i, k});
          else if (circle_pairs.size() == before)
            bound = std::min(bound, std::sqrt(squared) - reaches);
        }
      }
    } else if (nb.right == 0 || (na.right != 0 && na.reach >= nb.reach)) {
      stack[top++] = {na.right, pair.b};
      stack[top++] = {pair.a + 1, pair.b};
    } else {
      stack[top++] = {pair.a, nb.right};
      stack[top++] = {pair.a, pair.b + 1};
    }
  }
  return circle_pairs.size() == before ? bound : 0;
}

// ---- near edges

namespace {

/// Each edge of a with each piece of b that one of its own pieces is near, once and in order. Pieces have
/// consecutive edges, in the order of pieces: by these pairs the edges' own come sorted.
std::vector<NearPair> edges_near_pieces(const Covered& a, const std::vector<NearPair>& circle_pairs) {
  std::vector<NearPair> near;
  near.reserve(circle_pairs.size());
  for (const NearPair pair : circle_pairs) {
    const PieceEdges& piece = a.cover.pieces[pair.a];
    std::uint32_t edge = piece.first_edge;
    for (std::uint32_t i = 0; i < piece.edges; ++i, edge = a.edges.next[edge]) near.push_back({edge, pair.b});
  }
  std::sort(near.begin(), near.end());
  near.erase(std::unique(near.begin(), near.end()), near.end());
  return near;
}

/// Puts the ends of the pairs' edges beside them. Plain pointers: there may be thousands.
void fill_ends(const EdgeList& a, const EdgeList& b, NearEdges& edges) {
  const std::size_t count = edges.pairs.size();
  const std::size_t stride = edges.stride = (count + 3) / 4 * 4;
  edges.ends.resize(8 * stride);
  const Point* const of_a = a.vertices.data();
  const Point* const of_b = b.vertices.data();
  double* const ends = edges.ends.data();
  for (std::size_t i = 0; i < stride; ++i) {
    const bool is_pair = i < count;  // else what fills the last lanes
    const NearPair pair = is_pair ? edges.pairs[i] : NearPair{};
    const Point points[4] = {of_a[pair.a], of_a[a.next[pair.a]], of_b[pair.b], of_b[b.next[pair.b]]};
    for (std::size_t k = 0; k < 4; ++k) {
      ends[i + 2 * k * stride] = is_pair ? points[k].x : 0;
      ends[i + (2 * k + 1) * stride] = is_pair ? points[k].y : 0;
    }
  }
}

/// Square of the distance of two segments, 0 where they cross or touch [m²].
double squared_gap(Point a0, Point a1, Point b0, Point b1) {
  return are_across(a0, a1, b0, b1) ? 0 : squared_distance_of_ends(a0, a1, b0, b1);
}

double squared_gap(const Box& a, const Box& b) {
  const double x = std::max({0.0, a.low.x - b.high.x, b.low.x - a.high.x});
  const double y = std::max({0.0, a.low.y - b.high.y, b.low.y - a.high.y});
  return x * x + y * y;
}

}  // namespace

double near_edges(const EdgeList& a, const EdgeList& b, const Pose& a_from_b, double margin, NearEdges& edges) {
  std::array<Point, kFewEdges> b_in_a;
  Box around_b{transform(a_from_b, b.vertices.front()), transform(a_from_b, b.vertices.front())};
  for (std::size_t k = 0; k < b.size(); ++k) {
    b_in_a[k] = transform(a_from_b, b.vertices[k]);
    extend(around_b, b_in_a[k]);
  }
  edges.pairs.clear();
  double bound = std::numeric_limits<double>::infinity();  // squared, as `near`
  const double near = margin * margin;
  for (std::uint32_t i = 0; i < a.size(); ++i) {
    const Point from = a.from(i), to = a.to(i);
    const Box around = box_around(from, to);
    const double off = squared_gap(around, around_b);
    if (off > near) {
      bound = std::min(bound, off);
      continue;
    }
    for (std::uint32_t k = 0; k < b.size(); ++k) {
      const Point b_from = b_in_a[k], b_to = b_in_a[b.next[k]];
      double between = squared_gap(around, box_around(b_from, b_to));
      if (between <= near) between = squared_gap(from, to, b_from, b_to);
      if (between <= near)
        edges.pairs.push_back({i, k});
      else
        bound = std::min(bound, between);
    }
  }
  if (edges.pairs.empty()) return std::sqrt(bound);
  fill_ends(a, b, edges);
  return 0;
}

void edges_of(const Covered& a, const Covered& b, const std::vector<NearPair>& circle_pairs, NearEdges& edges) {
  std::vector<NearPair>& pairs = edges.pairs;
  pairs.clear();
  const std::vector<NearPair> near = edges_near_pieces(a, circle_pairs);
  for (const NearPair pair : near) {
    const PieceEdges& piece = b.cover.pieces[pair.b];
    std::uint32_t eb = piece.first_edge;
    for (std::uint32_t k = 0; k < piece.edges; ++k, eb = b.edges.next[eb]) {
      if (pairs.empty() || pairs.back() != NearPair{pair.a, eb}) pairs.push_back({pair.a, eb});
    }
  }
  fill_ends(a.edges, b.edges, edges);
}

double least_distance(const Pose& a_from_b, const NearEdges& edges) {
  double least = std::numeric_limits<double>::infinity();  // squared
  for (std::size_t i = 0; i < edges.pairs.size() && least > 0; ++i) {
    const auto end = [&](std::size_t k) {
      return Point{edges.ends[i + 2 * k * edges.stride], edges.ends[i + (2 * k + 1) * edges.stride]};
    };
    least = std::min(least, squared_gap(end(0), end(1), transform(a_from_b, end(2)), transform(a_from_b, end(3))));
  }
  return std::sqrt(least);
}

// ---- insides and clearance

bool is_inside(const EdgeList& edges, Point p) {
  bool inside = false;
  for (std::uint32_t edge = 0; edge < edges.size(); ++edge) {
    if (crosses_ray(edges.from(edge), edges.to(edge), p)) inside = !inside;
  }
  return inside;
}

bool is_one_inside(const Covered& a, const Covered& b, const Pose& a_from_b) {
  const CircleNode& around_a = a.cover.tree.front();
  const CircleNode& around_b = b.cover.tree.front();
  const double between = distance(around_a.centre, transform(a_from_b, around_b.centre));
  if (between > std::max(around_a.reach, around_b.reach)) return false;
  return is_one_inside(a.edges, b.edges, a_from_b);
}

bool is_one_inside(const EdgeList& a, const EdgeList& b, const Pose& a_from_b) {
  // All vertices: where two only touch, rounding may find one of them inside.
  return std::ranges::all_of(b.vertices, [&](Point p) { return is_inside(a, transform(a_from_b, p)); }) ||
         std::ranges::all_of(a.vertices, [&](Point p) { return is_inside(b, inverse_transform(a_from_b, p)); });
}

namespace {

/// Far more than what circles miss of their edges by rounding [m]. Without it an edge may be overlooked, and
/// bodies that overlap are clear; larger only costs time.
constexpr double kSlack = 1e-6;

/// As is_inside of all edges: no other edge is to the right of the point.
bool is_inside_boundary(const Boundary& boundary, Point p) {
  const auto is_to_the_right = [&](const BoundingCircle& circle) {
    const double reach = circle.reach + kSlack;
    return std::abs(circle.centre.y - p.y) <= reach && circle.centre.x + reach >= p.x;
  };
  bool inside = false;
  for_edges(boundary, is_to_the_right, [&](std::uint32_t edge) {
    if (crosses_ray(boundary.edges.from(edge), boundary.edges.to(edge), p)) inside = !inside;
  });
  return inside;
}

/// Whether an edge of a meets one of b, which is within the box, in a's frame.
bool do_edges_meet(const Boundary& a, const EdgeList& b, const Ring& b_in_a, const Box& box_of_b) {
  const Point centre = midpoint(box_of_b.low, box_of_b.high);
  const double radius = distance(centre, box_of_b.high) + kSlack;
  bool meets = false;
  const auto is_near = [&](const BoundingCircle& circle) {
    return !meets && distance(circle.centre, centre) <= circle.reach + radius;
  };
  for_edges(a, is_near, [&](std::uint32_t edge) {
    const Point from = a.edges.from(edge), to = a.edges.to(edge);
    const Box box = box_around(from, to);
    if (meets || !overlaps(box_of_b, box)) return;
    for (std::uint32_t j = 0; j < b.size() && !meets; ++j) {
      const Point b_from = b_in_a[j], b_to = b_in_a[b.next[j]];
      meets = overlaps(box, box_around(b_from, b_to)) && are_across(from, to, b_from, b_to);
    }
  });
  return meets;
}

}  // namespace

bool is_clear(const Boundary& a, const Boundary& b, const Pose& a_from_b) {
  Ring b_in_a;
  b_in_a.reserve(b.edges.size());
  for (const Point p : b.edges.vertices) b_in_a.push_back(transform(a_from_b, p));
  if (do_edges_meet(a, b.edges, b_in_a, bounding_box(b_in_a))) return false;
  // Where no edges meet, one vertex stands for all of its body.
  return !is_inside_boundary(a, b_in_a.front()) &&
         !is_inside(b.edges, inverse_transform(a_from_b, a.edges.vertices.front()));
}

}  // namespace polynya::geometry
