#include "io/scene/floe_group.hpp"

#include <algorithm>

#include "geometry/exact/measures.hpp"
#include "geometry/shape/pose.hpp"

namespace polynya::io {
namespace {

using geometry::Point;
using geometry::Polygon;
using geometry::Ring;
using geometry::Vector;

std::vector<Polygon> lattice(const FloeGroup& group) {
  std::vector<Polygon> floes;
  floes.reserve(static_cast<std::size_t>(group.columns) * static_cast<std::size_t>(group.rows));
  const Vector margin = 0.5 * (group.pitch - group.size);
  for (int row = 0; row < group.rows; ++row) {
    for (int column = 0; column < group.columns; ++column) {
      const Vector cell{column * group.pitch.x, row * group.pitch.y};
      floes.push_back(rectangle(group.origin + cell + margin, group.size));
    }
  }
  return floes;
}

void open_ring(Ring& ring) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

}  // namespace

Polygon rectangle(Point corner, Vector size) {
  return {{corner, {corner.x + size.x, corner.y}, corner + size, {corner.x, corner.y + size.y}}, {}};
}

std::vector<Polygon> floes_of(const FloeGroup& group) {
  switch (group.form) {
    case FloeGroup::Form::kLattice:
      return lattice(group);
    case FloeGroup::Form::kRectangle: {
      Polygon floe = rectangle(group.origin, group.size);
      if (group.angle == 0) return {floe};
      const geometry::Pose turned{group.origin, geometry::Rotation::by(group.angle)};
      for (Point& p : floe.outer) p = transform(turned, Point{} + (p - group.origin));
      return {floe};
    }
    case FloeGroup::Form::kPolygon:
      return {in_house_notation(group.polygon)};
    case FloeGroup::Form::kField:
    case FloeGroup::Form::kFile:
      break;
  }
  return {};
}

Polygon in_house_notation(Polygon polygon) {
  open_ring(polygon.outer);
  if (geometry::signed_area(polygon.outer) < 0) std::ranges::reverse(polygon.outer);
  for (Ring& hole : polygon.holes) {
    open_ring(hole);
    if (geometry::signed_area(hole) > 0) std::ranges::reverse(hole);
  }
  return polygon;
}

}  // namespace polynya::io
