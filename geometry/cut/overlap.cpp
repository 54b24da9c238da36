#include "geometry/cut/overlap.hpp"

#include <exception>
#include <new>

#include "geometry/cut/internal/arrangement.hpp"

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

// The outer ring's box in the world, with room for the rounding of its own arithmetic.
Box box_in_world(const Shape& shape, const Pose& world_from_body) {
  Ring ring;
  for (const Point p : shape.polygon.outer) ring.push_back(transform(world_from_body, p));
  const Box box = bounding_box(ring);
  const double size = length(box.high - box.low) + length(box.low - Point{}) + length(box.high - Point{});
  return grown(box, 1e-12 * size);
}

}  // namespace

tl::expected<Overlap, CutError> overlap(const Shape& a, const Pose& world_from_a, const Shape& b,
                                        const Pose& world_from_b) {
  if (!overlaps(box_in_world(a, world_from_a), box_in_world(b, world_from_b))) return Overlap{0, "0"};
  try {
    std::vector<exact::SourceSegment> segments;
    append_segments(segments, placed(a, world_from_a), 0);
    append_segments(segments, placed(b, world_from_b), 1);
    const auto shared = [](exact::Winding w) { return w.shape > 0 && w.tool > 0 ? 0 : -1; };
    exact::Rational sum = 0;
    for (const exact::Region& region : exact::overlay(segments, shared, exact::Seams::kDissolve).regions) {
      sum += exact::area(region.polygon);
    }
    return Overlap{exact::nearest_double(sum), sum.get_str()};
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& failure) {
    return tl::unexpected(CutError{CutFailure::kInternal, failure.what()});
  }
}

}  // namespace polynya::geometry
