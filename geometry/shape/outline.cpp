#include "geometry/shape/outline.hpp"

#include <exception>
#include <iterator>
#include <new>
#include <queue>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Constrained_triangulation_plus_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polyline_simplification_2/Squared_distance_cost.h>
#include <CGAL/Polyline_simplification_2/Stop_above_cost_threshold.h>
#include <CGAL/Polyline_simplification_2/simplify.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>
#include <CGAL/convex_hull_2.h>

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

namespace PS = CGAL::Polyline_simplification_2;
/// Rings are valid, so constraints do not cross. A vertex stores its number, a face the number of rings around it. A
/// vertex also stores data that only the simplification needs, so that only one kind of triangulation is compiled.
using VertexBase = PS::Vertex_base_2<Kernel, CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>>;
using FaceBase =
    CGAL::Constrained_triangulation_face_base_2<Kernel, CGAL::Triangulation_face_base_with_info_2<int, Kernel>>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;
using Plus = CGAL::Constrained_triangulation_plus_2<Triangulation>;

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

void insert(Triangulation& triangulation, const Ring& ring, std::uint32_t first) {
  std::vector<Triangulation::Vertex_handle> vertices;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t before = triangulation.number_of_vertices();
    const auto vertex = triangulation.insert(Kernel::Point_2(ring[i].x, ring[i].y));
    // Rings may touch at a corner, which then keeps its first number.
    if (triangulation.number_of_vertices() > before) vertex->info() = first + static_cast<std::uint32_t>(i);
    vertices.push_back(vertex);
  }
  for (std::size_t i = 0; i < ring.size(); ++i)
    triangulation.insert_constraint(vertices[i], vertices[(i + 1) % ring.size()]);
}

/// Counts, for each face, how many constraints lie between it and the outside.
void count_rings(Triangulation& triangulation) {
  for (const auto face : triangulation.all_face_handles()) face->info() = -1;
  std::queue<Triangulation::Face_handle> faces;
  triangulation.infinite_face()->info() = 0;
  faces.push(triangulation.infinite_face());
  std::queue<Triangulation::Face_handle> deeper;
  for (int depth = 0; !faces.empty(); ++depth, std::swap(faces, deeper)) {
    for (; !faces.empty(); faces.pop()) {
      const auto face = faces.front();
      for (int i = 0; i < 3; ++i) {
        const auto other = face->neighbor(i);
        const bool crosses = face->is_constrained(i);
        if (other->info() != -1 && !(other->info() == depth + 1 && !crosses)) continue;
        other->info() = depth + (crosses ? 1 : 0);
        (crosses ? deeper : faces).push(other);
      }
    }
  }
}

}  // namespace

Ring convex_hull(const std::vector<Point>& points) {
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

std::vector<Triangle> triangulate(const Polygon& polygon) {
  std::vector<Triangle> triangles;
  try {
    Triangulation triangulation;
    insert(triangulation, polygon.outer, 0);
    auto first = static_cast<std::uint32_t>(polygon.outer.size());
    for (const Ring& hole : polygon.holes) {
      insert(triangulation, hole, first);
      first += static_cast<std::uint32_t>(hole.size());
    }
    if (triangulation.dimension() < 2) return {};  // all points on one line: there is no face from which to count
    count_rings(triangulation);
    for (const auto face : triangulation.finite_face_handles()) {
      if (face->info() % 2 == 1)
        triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
  } catch (const CGAL::Failure_exception&) {
    return {};
  } catch (const Triangulation::Intersection_of_constraints_exception&) {  // the rings cross
    return {};
  }
  return triangles;
}

}  // namespace polynya::geometry
