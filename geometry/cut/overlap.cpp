#include "geometry/cut/overlap.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/cut/internal/arrangement.hpp"
#include "geometry/cut/internal/guarded.hpp"
#include "geometry/exact/internal/predicates.hpp"

namespace polynya::geometry {
namespace {

exact::Ring placed(const exact::Ring& ring, const Pose& world_from_body) {
  using exact::Rational;
  const Rational c(world_from_body.rotation.cosine);
  const Rational s(world_from_body.rotation.sine);
  const exact::Point origin = exact::exactly(world_from_body.position);
  exact::Ring result;
  result.reserve(ring.size());
  for (const exact::Point& p : ring) {
    result.push_back({origin.x + c * p.x - s * p.y, origin.y + s * p.x + c * p.y});
  }
  return result;
}

exact::Polygon placed(const Shape& shape, const Pose& world_from_body) {
  const exact::Polygon body = exact::exactly(shape.polygon);
  exact::Polygon result{placed(body.outer, world_from_body), {}};
  for (const exact::Ring& hole : body.holes) result.holes.push_back(placed(hole, world_from_body));
  return result;
}

bool is_usable_at(const Shape& shape, const Pose& world_from_body) {
  return is_usable(world_from_body.position) && are_usable(shape.polygon.outer) &&
         std::ranges::all_of(shape.polygon.holes, [](const Ring& hole) { return are_usable(hole); });
}

// The outer ring's box in the world, with room for the rounding of its own arithmetic.
Box box_in_world(const Shape& shape, const Pose& world_from_body) {
  const Box box = bounding_box(transform(world_from_body, shape.polygon.outer));
  const double size = length(box.high - box.low) + length(box.low - Point{}) + length(box.high - Point{});
  return grown(box, 1e-12 * size);
}

// b's outer ring in a's frame, in doubles, and how far it may be off there.
struct RingInFrame {
  Ring ring;
  Box box;
  double error = 0;  // [m]
};
RingInFrame ring_in_frame(const Pose& world_from_a, const Polygon& b, const Pose& world_from_b) {
  RingInFrame in_a;
  in_a.ring.reserve(b.outer.size());
  for (const Point p : b.outer)
    in_a.ring.push_back(inverse_transform(world_from_a, transform(world_from_b, p)));
  in_a.box = bounding_box(in_a.ring);
  in_a.error = 1e-12 * (length(in_a.box.low - Point{}) + length(in_a.box.high - Point{}) +
                        length(world_from_a.position - Point{}) + length(world_from_b.position - Point{}));
  return in_a;
}

// Whether an edge of one leaves the other so far aside that rounding cannot have done it: they share nothing.
bool are_apart(const Ring& a, const RingInFrame& b) {
  double size = 0;
  for (const Point p : a) size = std::max({size, std::abs(p.x), std::abs(p.y)});
  const double off = b.error + 1e-12 * size;
  constexpr double kFar = 1e50;  ///< beyond it products may overflow [m]
  if (!(off < kFar)) return false;
  return has_separating_edge(a, b.ring, off, -4 * off) || has_separating_edge(b.ring, a, off, -4 * off);
}

// Beyond which sides of the box a point is, a bit each.
unsigned sides_beyond(Point p, const Box& box) {
  return (p.x < box.low.x ? 1U : 0U) | (p.x > box.high.x ? 2U : 0U) | (p.y < box.low.y ? 4U : 0U) |
         (p.y > box.high.y ? 8U : 0U);
}

}  // namespace

tl::expected<Overlap, CutError> overlap(const Shape& a, const Pose& world_from_a, const Shape& b,
                                        const Pose& world_from_b) {
  if (!overlaps(box_in_world(a, world_from_a), box_in_world(b, world_from_b))) return Overlap{0, "0"};
  // CGAL leaks memory where it finds out itself.
  if (!is_usable_at(a, world_from_a) || !is_usable_at(b, world_from_b))
    return refuse(CutFailure::kInvalidShape, Defect::kNotFinite);
  return guarded([&]() -> tl::expected<Overlap, CutError> {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, placed(a, world_from_a), 0);
    append_segments(segments, placed(b, world_from_b), 1);
    const auto shared = [](exact::Winding w) { return w.shape > 0 && w.tool > 0 ? 0 : -1; };
    exact::Rational sum = 0;
    for (const exact::Region& region : exact::overlay(segments, shared, exact::Seams::kDissolve).regions)
      sum += exact::area(region.polygon);
    return Overlap{exact::nearest_double(sum), sum.get_str()};
  });
}

tl::expected<double, CutError> shared_area(const Polygon& a, const Pose& world_from_a, const Polygon& b,
                                           const Pose& world_from_b) {
  if (vertex_count(a) < vertex_count(b)) return shared_area(b, world_from_b, a, world_from_a);
  const RingInFrame b_in_a = ring_in_frame(world_from_a, b, world_from_b);
  const Box box = grown(b_in_a.box, b_in_a.error);
  Polygon near{near_part(a.outer, box), {}};
  if (near.outer.size() < 3 || are_apart(near.outer, b_in_a)) return 0;
  for (const Ring& hole : a.holes) {
    if (Ring part = near_part(hole, box); part.size() > 2) near.holes.push_back(std::move(part));
  }
  // The near part may cross itself, as overlap allows. Where it winds differently from the whole, b does not
  // wind at all.
  return overlap({.polygon = std::move(near)}, world_from_a, {.polygon = b}, world_from_b)
      .map(&Overlap::area);
}

bool has_separating_edge(const Ring& a, const Ring& b, double most_of_a, double most_of_b) {
  for (std::size_t i = 0; i < a.size(); ++i) {
    const Point from = a[i];
    const Vector edge = a[(i + 1) % a.size()] - from;
    const double size = length(edge);
    if (size == 0) continue;
    const auto side = [&](Point p) { return cross(edge, p - from); };
    if (std::ranges::all_of(b, [&](Point p) { return side(p) <= most_of_b * size; }) &&
        std::ranges::all_of(a, [&](Point p) { return side(p) >= -most_of_a * size; }))
      return true;
  }
  return false;
}

Ring near_part(const Ring& ring, const Box& box) {
  if (ring.empty()) return {};
  Ring kept{ring.front()};
  Point last = ring.front();  // of the run that starts at kept.back()
  unsigned run = sides_beyond(last, box);
  for (std::size_t i = 1; i < ring.size(); ++i) {
    const unsigned sides = sides_beyond(ring[i], box);
    if ((run & sides) == 0 && last != kept.back()) {
      kept.push_back(last);
      run = sides_beyond(last, box);
    }
    if ((run & sides) == 0) {
      kept.push_back(ring[i]);
      run = sides;
    } else {
      run &= sides;
    }
    last = ring[i];
  }
  if (last != kept.back()) kept.push_back(last);
  return kept;
}

}  // namespace polynya::geometry
