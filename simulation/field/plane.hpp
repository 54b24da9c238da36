#pragma once

#include <cmath>

#include "geometry/shape/polygon.hpp"

namespace polynya::simulation {

/// The plane in which a field's floes are roundish: turned by `along`, and shrunk along it by as much as it
/// is stretched across. Areas are the same as in the world.
struct Plane {
  geometry::Vector along{1, 0};  ///< unit vector in the world
  double stretch = 1;            ///< of a floe along that direction over its width, ≥ 1

  geometry::Point from_world(geometry::Point p) const {
    const geometry::Vector v = p - geometry::Point{};
    const double root = std::sqrt(stretch);
    return {dot(along, v) / root, cross(along, v) * root};
  }
  geometry::Point to_world(geometry::Point p) const {
    const double root = std::sqrt(stretch);
    return geometry::Point{} + (p.x * root) * along + (p.y / root) * perpendicular(along);
  }
  geometry::Ring from_world(geometry::Ring ring) const {
    if (!is_world()) {
      for (geometry::Point& p : ring) p = from_world(p);
    }
    return ring;
  }
  geometry::Ring to_world(geometry::Ring ring) const {
    if (!is_world()) {
      for (geometry::Point& p : ring) p = to_world(p);
    }
    return ring;
  }
  bool is_world() const { return stretch == 1 && along == geometry::Vector{1, 0}; }
};

}  // namespace polynya::simulation
