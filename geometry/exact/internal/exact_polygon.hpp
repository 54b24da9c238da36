#pragma once

#include <vector>

#include "geometry/exact/internal/rational.hpp"
#include "geometry/shape/polygon.hpp"

namespace polynya::geometry::exact {

using Ring = std::vector<Point>;

/// A polygon with rational vertices: the outer ring counter-clockwise, holes clockwise.
struct Polygon {
  Ring outer;
  std::vector<Ring> holes;
};

Ring exactly(const geometry::Ring& ring);
Polygon exactly(const geometry::Polygon& polygon);

/// Every vertex to its nearest doubles. Nothing is welded: the result may be invalid.
geometry::Ring rounded(const Ring& ring);
geometry::Polygon rounded(const Polygon& polygon);

/// Signed area: positive where the ring runs counter-clockwise [m²].
Rational area(const Ring& ring);
/// Area with the holes (which run clockwise) taken off [m²].
Rational area(const Polygon& polygon);
Rational area(const geometry::Ring& ring);
Rational area(const geometry::Polygon& polygon);

}  // namespace polynya::geometry::exact
