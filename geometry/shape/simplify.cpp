#include "geometry/shape/simplify.hpp"

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyline_simplification_2/Squared_distance_cost.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>

namespace polynya::geometry {
namespace {

namespace PS = CGAL::Polyline_simplification_2;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Vertex = PS::Vertex_base_2<Kernel>;
using Face = CGAL::Constrained_triangulation_face_base_2<Kernel>;
using Structure = CGAL::Triangulation_data_structure_2<Vertex, Face>;
using Constrained =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Plus = CGAL::Constrained_triangulation_plus_2<Constrained>;

Plus::Constraint_id insert(Plus& plus, const Ring& ring) {
  std::vector<Kernel::Point_2> points;
  points.reserve(ring.size());
  for (const Point p : ring) points.emplace_back(p.x, p.y);
  return plus.insert_constraint(points.begin(), points.end(), true);
}

Ring ring_of(const Plus& plus, Plus::Constraint_id id) {
  Ring ring;
  for (auto p = plus.points_in_constraint_begin(id); p != plus.points_in_constraint_end(id); ++p)
    ring.push_back({p->x(), p->y()});
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

}  // namespace

Polygon simplified(const Polygon& polygon, double tolerance) try {
  Plus plus;
  const Plus::Constraint_id outer = insert(plus, polygon.outer);
  std::vector<Plus::Constraint_id> holes;
  holes.reserve(polygon.holes.size());
  for (const Ring& hole : polygon.holes) holes.push_back(insert(plus, hole));
  PS::simplify(plus, PS::Squared_distance_cost(), PS::Stop_above_cost_threshold(tolerance * tolerance));
  Polygon result{ring_of(plus, outer), {}};
  for (const Plus::Constraint_id hole : holes) result.holes.push_back(ring_of(plus, hole));
  return result;
} catch (const CGAL::Failure_exception&) {
  return polygon;
}

}  // namespace polynya::geometry
