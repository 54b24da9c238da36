#include "io/text/near_part.hpp"

#include "geometry/cut/overlap.hpp"

namespace polynya::io {
namespace {

using geometry::Box;
using geometry::Point;
using geometry::Polygon;
using geometry::Pose;
using geometry::Ring;

/// Beyond which sides of the box a point is, a bit each.
unsigned sides_beyond(Point p, const Box& box) {
  return (p.x < box.low.x ? 1U : 0U) | (p.x > box.high.x ? 2U : 0U) | (p.y < box.low.y ? 4U : 0U) |
         (p.y > box.high.y ? 8U : 0U);
}

/// The box of b in a's frame, with room for the rounding of its own arithmetic.
Box box_in_frame(const Pose& world_from_a, const Polygon& b, const Pose& world_from_b) {
  Ring ring;
  ring.reserve(b.outer.size());
  for (const Point p : b.outer) ring.push_back(inverse_transform(world_from_a, transform(world_from_b, p)));
  const Box box = bounding_box(ring);
  const Point world = world_from_a.position;
  const double size = length(box.low - Point{}) + length(box.high - Point{}) + length(world - Point{}) +
                      length(world_from_b.position - Point{});
  return grown(box, 1e-12 * size);
}

}  // namespace

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

std::optional<double> shared_area(const Polygon& a, const Pose& world_from_a, const Polygon& b,
                                  const Pose& world_from_b) {
  if (vertex_count(a) < vertex_count(b)) return shared_area(b, world_from_b, a, world_from_a);
  const Box box = box_in_frame(world_from_a, b, world_from_b);
  Polygon near{near_part(a.outer, box), {}};
  if (near.outer.size() < 3) return 0;
  for (const Ring& hole : a.holes) {
    if (Ring part = near_part(hole, box); part.size() > 2) near.holes.push_back(std::move(part));
  }
  // The near part may cross itself, as overlap allows. Where it winds differently from the whole, b does not
  // wind at all.
  const auto shared =
      geometry::overlap({.polygon = std::move(near)}, world_from_a, {.polygon = b}, world_from_b);
  if (!shared) return {};
  return shared->area;
}

}  // namespace polynya::io
