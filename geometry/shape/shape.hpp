#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// A floe's shape at rest in its body frame. Every double is a rational: these are its exact coordinates.
struct Shape {
  Polygon polygon;
  /// Set by the cuts on their pieces, which are valid: the next cut does not validate them again. Clear it
  /// after editing `polygon`.
  bool known_valid = false;
};

}  // namespace polynya::geometry
