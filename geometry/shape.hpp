#pragma once

#include <memory>

#include "geometry/polygon.hpp"

namespace polynya::geometry {

namespace exact {
struct Polygon;  ///< rings of plain rationals (geometry/internal/exact_polygon.hpp)
}

/// A floe's shape at rest in its body frame. Its doubles are its exact coordinates (every double is a
/// rational), but for the rare shape that would not round validly after a cut: that one keeps its rationals
/// in `exact`, and `polygon` is then their nearest doubles, for looking at and for contacts, not for cutting.
struct Shape {
  Polygon polygon;
  std::shared_ptr<const exact::Polygon> exact = nullptr;  ///< null where the doubles are the shape
  /// Set by the cuts on their pieces, whose validity they have just established: the next cut need not look
  /// again. Whoever edits `polygon` by hand clears it.
  bool known_valid = false;
};

}  // namespace polynya::geometry
