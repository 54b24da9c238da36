#include "simulation/field/obstacles.hpp"

#include "geometry/exact/measures.hpp"
#include "simulation/field/convex.hpp"

namespace polynya::simulation {

using geometry::Box;
using geometry::Polygon;
using geometry::Ring;

Obstacles::Obstacles(const FloeField& field) : field_(field) {
  for (const Polygon& polygon : field.kept_clear)
    boxes_.push_back(grown(bounding_box(polygon.outer), field.gap));
}

bool Obstacles::forbid(const Ring& floe) const {
  if (!field_.is_rectangle &&
      (is_near_ring(floe, field_.region, 0) || !geometry::contains({field_.region, {}}, floe.front())))
    return true;
  const Box box = bounding_box(floe);
  for (std::size_t i = 0; i < boxes_.size(); ++i) {
    if (!overlaps(box, boxes_[i])) continue;
    const Polygon& polygon = field_.kept_clear[i];
    if (is_near_ring(floe, polygon.outer, field_.gap) || geometry::contains(polygon, floe.front()) ||
        geometry::contains({floe, {}}, polygon.outer.front()))
      return true;
  }
  return false;
}

}  // namespace polynya::simulation
