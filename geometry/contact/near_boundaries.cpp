#include "geometry/contact/near_boundaries.hpp"

#include <array>
#include <cmath>

#include "geometry/exact/predicates.hpp"
#include "geometry/shape/segments.hpp"

namespace polynya::geometry {

// ---- near circles

namespace {

double gap(const CircleNode& a, const CircleNode& b, Point b_centre_in_a) {
  return distance(a.centre, b_centre_in_a) - a.reach - b.reach;
}

}  // namespace

double near_circles(const Covered& a, const Covered& b, const Pose& a_from_b, double margin,
                    std::vector<NearPair>& circle_pairs) {
  double bound = std::numeric_limits<double>::infinity();
  const std::size_t before = circle_pairs.size();
  NearPair stack[128];  // depth of both trees; enough for a boundary of 2^60 circles
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

/// Returns each edge of a with each piece of b to which one of its own pieces is near, once and in order. The pieces of
/// an edge are consecutive, in the order of pieces, so these pairs are sorted by edge.
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

/// Stores the ends of the pairs' edges beside them. Plain pointers are used, since there may be thousands.
void fill_ends(const EdgeList& a, const EdgeList& b, NearEdges& edges) {
  const std::size_t count = edges.pairs.size();
  const std::size_t stride = edges.stride = (count + 3) / 4 * 4;
  edges.ends.resize(8 * stride);
  const Point* const of_a = a.vertices.data();
  const Point* const of_b = b.vertices.data();
  double* const ends = edges.ends.data();
  for (std::size_t i = 0; i < stride; ++i) {
    const bool is_pair = i < count;  // otherwise a filler of the last lanes
    const NearPair pair = is_pair ? edges.pairs[i] : NearPair{};
    const Point points[4] = {of_a[pair.a], of_a[a.next[pair.a]], of_b[pair.b], of_b[b.next[pair.b]]};
    for (std::size_t k = 0; k < 4; ++k) {
      ends[i + 2 * k * stride] = is_pair ? points[k].x : 0;
      ends[i + (2 * k + 1) * stride] = is_pair ? points[k].y : 0;
    }
  }
}

/// Returns the square of the distance of two segments; 0 if they cross or touch [m²].
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

bool is_one_inside(const Covered& a, const Covered& b, const Pose& a_from_b) {
  const CircleNode& around_a = a.cover.tree.front();
  const CircleNode& around_b = b.cover.tree.front();
  const double between = distance(around_a.centre, transform(a_from_b, around_b.centre));
  if (between > std::max(around_a.reach, around_b.reach)) return false;
  return is_one_inside(a.edges, b.edges, a_from_b);
}

bool is_one_inside(const EdgeList& a, const EdgeList& b, const Pose& a_from_b) {
  // All vertices are tested: if two bodies only touch, rounding may find one vertex inside.
  return std::ranges::all_of(b.vertices, [&](Point p) { return is_inside(a, transform(a_from_b, p)); }) ||
         std::ranges::all_of(a.vertices, [&](Point p) { return is_inside(b, inverse_transform(a_from_b, p)); });
}

namespace {

/// Margin that is far larger than the distance by which circles miss their edges through rounding [m]. Without it an
/// edge may be overlooked, and bodies that overlap count as clear. Larger: only more time.
constexpr double kSlack = 1e-6;

/// Returns what is_inside returns for all edges. Edges that are not found here are not to the right of the point.
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

/// Returns true if an edge of a crosses or touches one of b, which lies within the box, in a's frame.
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
  // If no edges cross or touch, one vertex decides for all of its body.
  return !is_inside_boundary(a, b_in_a.front()) &&
         !is_inside(b.edges, inverse_transform(a_from_b, a.edges.vertices.front()));
}

}  // namespace polynya::geometry
