#pragma once

#include "geometry/shape/polygon.hpp"

namespace polynya::geometry {

/// A floe's shape at rest in its body frame. Every double is a rational: these are its exact coordinates.
struct Shape {
  Polygon polygon;
  /// Set by the cuts on their pieces, whose validity they have just established: the next cut need not look
  /// again. Whoever edits `polygon` by hand clears it.
  bool known_valid = false;
};

}  // namespace polynya::geometry
