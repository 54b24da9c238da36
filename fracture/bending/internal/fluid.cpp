#include "fracture/bending/internal/fluid.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace polynya::fracture {
namespace {

using Point = Eigen::Vector2d;

double cross(const Point& a, const Point& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Returns 4π times the velocity in z at a point of the plane by a straight vortex of unit strength from `start` to
/// `end`. The formula gives the limit, zero, for a point on the line but beyond the segment.
double vortex_segment(const Point& point, const Point& start, const Point& end) {
  const Point a = start - point, b = end - point;
  const double la = a.norm(), lb = b.norm();
  return cross(a, b) * (la + lb) / (la * lb * (la * lb + a.dot(b)));
}

/// The border of a panel, counter-clockwise, with its two arcs as chords.
using Border = std::vector<Point>;

/// Largest sagitta of the chords of an arc, as a fraction of the panel's depth along the radius [-]. The number of
/// chords per arc is the same for all panels, so that neighbours share their borders.
constexpr double kSagitta = 0.005;

int chords_per_arc(const PanelMesh& mesh) {
  double shortest = 1, widest = 0;  // the first is relative to the ring's radius
  for (std::size_t i = 0; i + 1 < mesh.rings.size(); ++i)
    shortest = std::min(shortest, 1 - mesh.rings[i] / mesh.rings[i + 1]);
  for (std::size_t j = 0; j + 1 < mesh.rays.size(); ++j) widest = std::max(widest, mesh.rays[j + 1] - mesh.rays[j]);
  return static_cast<int>(std::ceil(widest / std::sqrt(8 * kSagitta * shortest)));
}

Border border(const PanelMesh& mesh, std::size_t ring, std::size_t column, int chords) {
  const double first = mesh.rays[column], step = (mesh.rays[column + 1] - first) / chords;
  // The corners lie slightly outside of the arc, so that the chords lie on it in the mean: the mean depth of a chord is
  // r step² / 12.
  const double outward = 1 + step * step / 12;
  const auto at = [&](double r, int k) {
    return Point(r * outward * std::cos(first + step * k), r * outward * std::sin(first + step * k));
  };
  Border points;
  for (int k = 0; k <= chords; ++k) points.push_back(at(mesh.rings[ring + 1], k));
  for (int k = chords; k >= 0; --k) points.push_back(at(mesh.rings[ring], k));
  return points;
}

Border mirrored(Border points) {
  std::reverse(points.begin(), points.end());
  for (Point& p : points) p.y() = -p.y();
  return points;
}

double vortex_ring(const Point& point, const Border& points) {
  double sum = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Point &start = points[i], &end = points[(i + 1) % points.size()];
    if (start != end) sum += vortex_segment(point, start, end);
  }
  return sum / (4 * std::numbers::pi);
}

}  // namespace

PanelMesh make_panel_mesh(const std::vector<double>& rings_and_controls, const std::vector<double>& rays_and_controls) {
  PanelMesh mesh;
  for (std::size_t i = 0; i < rings_and_controls.size(); i += 2) mesh.rings.push_back(rings_and_controls[i]);
  for (std::size_t j = 0; j < rays_and_controls.size(); j += 2) mesh.rays.push_back(rays_and_controls[j]);
  std::vector<double> areas;
  for (std::size_t i = 0; i + 1 < mesh.rings.size(); ++i) {
    for (std::size_t j = 0; j + 1 < mesh.rays.size(); ++j) {
      const double inner = mesh.rings[i], outer = mesh.rings[i + 1];
      areas.push_back((outer * outer - inner * inner) * (mesh.rays[j + 1] - mesh.rays[j]));
      mesh.radii.push_back(rings_and_controls[2 * i + 1]);
      mesh.angles.push_back(rays_and_controls[2 * j + 1]);
    }
  }
  mesh.areas = Eigen::Map<const Eigen::VectorXd>(areas.data(), static_cast<Eigen::Index>(areas.size()));
  return mesh;
}

std::vector<double> rays_towards_edge(double from, double edge, int columns) {
  std::vector<double> rays;
  for (int j = 0; j <= 2 * columns; ++j)
    rays.push_back(from + (edge - from) * std::sin(0.25 * std::numbers::pi * j / columns));
  return rays;
}

Eigen::MatrixXd surface_flux(const PanelMesh& mesh) {
  const std::size_t columns = mesh.rays.size() - 1;
  const int chords = chords_per_arc(mesh);
  Eigen::MatrixXd flux(mesh.size(), mesh.size());
  for (int j = 0; j < mesh.size(); ++j) {
    const Border panel =
        border(mesh, static_cast<std::size_t>(j) / columns, static_cast<std::size_t>(j) % columns, chords);
    const Border image = mirrored(panel);
    for (int i = 0; i < mesh.size(); ++i) {
      const double r = mesh.radii[static_cast<std::size_t>(i)], angle = mesh.angles[static_cast<std::size_t>(i)];
      const Point point(r * std::cos(angle), r * std::sin(angle));
      // The doublet strength is the jump of the odd potential across z = 0, twice the potential below.
      flux(i, j) = mesh.areas[i] * 2 * (vortex_ring(point, panel) + vortex_ring(point, image));
    }
  }
  return 0.5 * (flux + flux.transpose());
}

Eigen::MatrixXd added_mass(const PanelMesh& mesh) {
  const Eigen::LLT<Eigen::MatrixXd> factor(surface_flux(mesh));
  if (factor.info() != Eigen::Success) return {};
  const Eigen::MatrixXd area = mesh.areas.asDiagonal();
  const Eigen::MatrixXd mass = area * factor.solve(area);
  return 0.5 * (mass + mass.transpose());
}

}  // namespace polynya::fracture
