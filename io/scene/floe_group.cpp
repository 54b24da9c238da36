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

void open_ring(Ring& ring) {
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
}

}  // namespace

Polygon rectangle(Point corner, Vector size) {
  return {{corner, {corner.x + size.x, corner.y}, corner + size, {corner.x, corner.y + size.y}}, {}};
}

std::vector<Polygon> floes_of(const LatticeInput& lattice) {
  std::vector<Polygon> floes;
  floes.reserve(static_cast<std::size_t>(lattice.columns) * static_cast<std::size_t>(lattice.rows));
  const Vector margin = 0.5 * (lattice.pitch - lattice.size);
  for (int row = 0; row < lattice.rows; ++row) {
    for (int column = 0; column < lattice.columns; ++column) {
      const Vector cell{column * lattice.pitch.x, row * lattice.pitch.y};
      floes.push_back(rectangle(lattice.origin + cell + margin, lattice.size));
    }
  }
  return floes;
}

Polygon floe_of(const RectangleInput& input) {
  Polygon floe = rectangle(input.corner, input.size);
  if (input.angle == 0) return floe;
  const geometry::Pose turned{input.corner, geometry::Rotation::by(input.angle)};
  for (Point& p : floe.outer) p = transform(turned, Point{} + (p - input.corner));
  return floe;
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
