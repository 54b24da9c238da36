#include "geometry/contact/contact_circles.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "geometry/contact/boundary_edges.hpp"

namespace polynya::geometry {
namespace {

/// Edges by the square cells their boxes touch, for finding those near a point. Built once per sampling.
class EdgeGrid {
 public:
  EdgeGrid(const EdgeList& edges, double cell) : cell_(cell) {
    const Box box = bounding_box(edges.vertices);
    double total = 0;
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      total += distance(edges.from(e), edges.to(e));
    }
    // No more cells than a few per edge and circle, however large the floe is beside its circles.
    const double width = box.high.x - box.low.x;
    const double height = box.high.y - box.low.y;
    const double most = 4.0 * static_cast<double>(edges.size()) + 4.0 * total / cell + 16;
    cell_ = std::max(cell_, std::sqrt(width * height / most));
    low_ = box.low;
    columns_ = static_cast<std::int64_t>(width / cell_) + 1;
    rows_ = static_cast<std::int64_t>(height / cell_) + 1;
    fill(edges);
  }

  template <typename Visit>
  void near(Point p, double radius, Visit visit) const {
    const auto [c0, c1] = span(p.x - radius - low_.x, p.x + radius - low_.x, columns_);
    const auto [r0, r1] = span(p.y - radius - low_.y, p.y + radius - low_.y, rows_);
    for (std::int64_t r = r0; r <= r1; ++r) {
      for (std::int64_t c = c0; c <= c1; ++c) {
        const auto cell = static_cast<std::size_t>(r * columns_ + c);
        for (std::uint32_t k = begin_[cell]; k < begin_[cell + 1]; ++k) visit(edge_[k]);
      }
    }
  }

 private:
  std::pair<std::int64_t, std::int64_t> span(double low, double high, std::int64_t count) const {
    const auto cell_of = [&](double x) {
      return std::clamp(static_cast<std::int64_t>(std::floor(x / cell_)), std::int64_t{0}, count - 1);
    };
    return {cell_of(low), cell_of(high)};
  }

  /// Visits the cells an edge passes, column by column, so that a long slanted edge does not fill its whole
  /// box.
  template <typename Visit>
  void for_cells_of(Point a, Point b, Visit visit) const {
    if (a.x > b.x) std::swap(a, b);
    const auto [c0, c1] = span(a.x - low_.x, b.x - low_.x, columns_);
    for (std::int64_t c = c0; c <= c1; ++c) {
      const double slope = b.x > a.x ? (b.y - a.y) / (b.x - a.x) : 0;
      const double x0 = std::clamp(low_.x + static_cast<double>(c) * cell_, a.x, b.x);
      const double x1 = std::clamp(low_.x + static_cast<double>(c + 1) * cell_, a.x, b.x);
      double y0 = a.y + slope * (x0 - a.x);
      double y1 = a.y + slope * (x1 - a.x);
      if (b.x == a.x) y0 = a.y, y1 = b.y;
      const double slack = 1e-9 * cell_;
      const auto [r0, r1] = span(std::min(y0, y1) - slack - low_.y, std::max(y0, y1) + slack - low_.y, rows_);
      for (std::int64_t r = r0; r <= r1; ++r) visit(static_cast<std::size_t>(r * columns_ + c));
    }
  }

  void fill(const EdgeList& edges) {
    begin_.assign(static_cast<std::size_t>(columns_ * rows_) + 1, 0);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      for_cells_of(edges.from(e), edges.to(e), [&](std::size_t cell) { ++begin_[cell + 1]; });
    }
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    edge_.resize(begin_.back());
    std::vector<std::uint32_t> at(begin_.begin(), begin_.end() - 1);
    for (std::uint32_t e = 0; e < edges.size(); ++e) {
      for_cells_of(edges.from(e), edges.to(e), [&](std::size_t cell) { edge_[at[cell]++] = e; });
    }
  }

  double cell_;
  Point low_;
  std::int64_t columns_ = 1;
  std::int64_t rows_ = 1;
  std::vector<std::uint32_t> begin_;
  std::vector<std::uint32_t> edge_;
};

/// The largest circle up to `radius` that touches the boundary at `touch` from inside and holds no boundary
/// point: shrink the circle onto the nearest boundary point inside it until there is none.
double inscribed_radius(const EdgeList& edges, const EdgeGrid& grid, Point touch, Vector inward,
                        double radius) {
  constexpr int kMostShrinks = 64;  // a few are the rule; very sharp corners took up to twenty
  for (int shrink = 0; shrink < kMostShrinks; ++shrink) {
    const Point centre = touch + radius * inward;
    const double inside = radius * (1 - 1e-9);
    double nearest = inside * inside;
    Point intruder;
    bool is_free = true;
    grid.near(centre, radius, [&](std::uint32_t e) {
      const Point q = nearest_on_segment(edges.from(e), edges.to(e), centre);
      const double d = squared_length(q - centre);
      // A point level with the touching point lies on its own edge: no smaller circle avoids it.
      if (d < nearest && dot(q - touch, inward) > 1e-12 * radius) {
        nearest = d;
        intruder = q;
        is_free = false;
      }
    });
    if (is_free) break;
    radius = squared_length(intruder - touch) / (2 * dot(intruder - touch, inward));
  }
  return radius;
}

/// Sets the middle and the reach of a run of whole edges of these lengths, and of this length in all [m].
void measure_run(const EdgeList& edges, const std::vector<double>& lengths, BoundaryPiece& piece,
                 double total) {
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

ContactCircle circle_for(const EdgeList& edges, const EdgeGrid& grid, const BoundaryPiece& piece,
                         double radius) {
  const Vector along = edges.to(piece.middle_edge) - edges.from(piece.middle_edge);
  const Vector inward = perpendicular(along) / length(along);
  ContactCircle circle;
  circle.radius = inscribed_radius(edges, grid, piece.middle, inward, radius);
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

std::vector<BoundaryPiece> boundary_pieces(const EdgeList& edges, double radius) {
  return boundary_pieces(edges, radius, std::numeric_limits<double>::infinity());
}

std::vector<ContactCircle> sample_contact_circles(const EdgeList& edges,
                                                  const std::vector<BoundaryPiece>& pieces, double radius) {
  std::vector<ContactCircle> circles;
  circles.reserve(pieces.size());
  const EdgeGrid grid(edges, 2 * radius);
  for (const BoundaryPiece& piece : pieces) circles.push_back(circle_for(edges, grid, piece, radius));
  return circles;
}

}  // namespace polynya::geometry
