#include "geometry/shape/convex_hull.hpp"

#include <iterator>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

namespace polynya::geometry {

Ring convex_hull(const std::vector<Point>& points) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> corners;
  corners.reserve(points.size());
  for (const Point p : points) corners.emplace_back(p.x, p.y);
  std::vector<Kernel::Point_2> hull;
  CGAL::convex_hull_2(corners.begin(), corners.end(), std::back_inserter(hull));
  Ring ring;
  ring.reserve(hull.size());
  for (const Kernel::Point_2& p : hull) ring.push_back({p.x(), p.y()});
  return ring;
}

}  // namespace polynya::geometry
