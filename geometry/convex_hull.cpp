#include "geometry/convex_hull.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/convex_hull_2.h>

#include <iterator>

namespace polynya::geometry {

Ring convex_hull(const Ring& ring) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  std::vector<Kernel::Point_2> points;
  points.reserve(ring.size());
  for (const Point p : ring) points.emplace_back(p.x, p.y);
  std::vector<Kernel::Point_2> corners;
  CGAL::convex_hull_2(points.begin(), points.end(), std::back_inserter(corners));
  Ring hull;
  hull.reserve(corners.size());
  for (const Kernel::Point_2& p : corners) hull.push_back({p.x(), p.y()});
  return hull;
}

}  // namespace polynya::geometry
