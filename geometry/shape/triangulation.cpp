#include "geometry/shape/triangulation.hpp"

#include <exception>
#include <new>
#include <queue>

#include <CGAL/Constrained_Delaunay_triangulation_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Triangulation_face_base_with_info_2.h>
#include <CGAL/Triangulation_vertex_base_with_info_2.h>

namespace polynya::geometry {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using VertexBase = CGAL::Triangulation_vertex_base_with_info_2<std::uint32_t, Kernel>;
using PlainFaceBase = CGAL::Triangulation_face_base_with_info_2<int, Kernel>;  // how many rings around it
using FaceBase = CGAL::Constrained_triangulation_face_base_2<Kernel, PlainFaceBase>;
using Structure = CGAL::Triangulation_data_structure_2<VertexBase, FaceBase>;
using Triangulation =
    CGAL::Constrained_Delaunay_triangulation_2<Kernel, Structure,
                                               CGAL::No_constraint_intersection_requiring_constructions_tag>;

void insert(Triangulation& triangulation, const Ring& ring, std::uint32_t first) {
  std::vector<Triangulation::Vertex_handle> vertices;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const std::size_t before = triangulation.number_of_vertices();
    const auto vertex = triangulation.insert(Kernel::Point_2(ring[i].x, ring[i].y));
    // Rings may touch at a corner: its first number stays.
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
    if (triangulation.dimension() < 2) return {};  // all on one line: there is no face to count from
    count_rings(triangulation);
    for (const auto face : triangulation.finite_face_handles()) {
      if (face->info() % 2 == 1)
        triangles.push_back({face->vertex(0)->info(), face->vertex(1)->info(), face->vertex(2)->info()});
    }
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception&) {
    return {};
  }
  return triangles;
}

}  // namespace polynya::geometry
