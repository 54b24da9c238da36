#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "geometry/contact/boundary.hpp"
#include "geometry/shape/point.hpp"

namespace polynya::geometry {
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
  const double b_sides = cross(a1 - a0, b0 - a0) * cross(a1 - a0, b1 - a0);
  const double a_sides = cross(b1 - b0, a0 - b0) * cross(b1 - b0, a1 - b0);
  if (b_sides <= 0 && a_sides <= 0) return 0;
  const auto squared_to_segment = [](Point p, Point from, Point to) {
    return squared_length(nearest_on_segment(from, to, p) - p);
  };
  return std::min({squared_to_segment(a0, b0, b1), squared_to_segment(a1, b0, b1), squared_to_segment(b0, a0, a1),
                   squared_to_segment(b1, a0, a1)});
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

}  // namespace polynya::geometry
