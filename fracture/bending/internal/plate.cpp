#include "fracture/bending/internal/plate.hpp"

#include <algorithm>
#include <cassert>

#include <boost/math/special_functions/legendre.hpp>

namespace polynya::fracture {
namespace {

constexpr double kEvenRadius = 2;  ///< radius at which the spacing turns from geometric to even, in l

/// An even Legendre polynomial P_2j(x) and its derivatives.
struct Legendre {
  double value, first, second;
};

/// Computed by the recurrences n P_n = (2n−1) x P_{n−1} − (n−1) P_{n−2} and P'_n = P'_{n−2} + (2n−1) P_{n−1}.
std::vector<Legendre> even_legendre(double x, int terms) {
  std::vector<Legendre> all = {{1, 0, 0}, {x, 1, 0}};
  for (int n = 2; n < 2 * terms; ++n) {
    const Legendre &a = all[all.size() - 1], &b = all[all.size() - 2];
    all.push_back({((2 * n - 1) * x * a.value - (n - 1) * b.value) / n, b.first + (2 * n - 1) * a.value,
                   b.second + (2 * n - 1) * a.first});
  }
  std::vector<Legendre> even;
  even.reserve(all.size());
  for (std::size_t n = 0; n < all.size() && even.size() < static_cast<std::size_t>(terms); n += 2)
    even.push_back(all[n]);
  return even;
}

/// Returns the half 0 < x < 1 of the Gauss–Legendre rule of 2n points on [-1, 1], exact for even integrands up to
/// degree 4n − 1.
std::vector<GaussPoint> even_gauss_rule(int n) {
  std::vector<GaussPoint> rule;
  for (const double x : boost::math::legendre_p_zeros<double>(2 * n)) {
    const double slope = boost::math::legendre_p_prime(2 * n, x);
    rule.push_back({x, 2 / ((1 - x * x) * slope * slope)});
  }
  return rule;
}

int element_at(const PlateMesh& mesh, double radius) {
  const auto after = std::upper_bound(mesh.radii.begin(), mesh.radii.end(), radius);
  return std::clamp(static_cast<int>(after - mesh.radii.begin()) - 1, 0, mesh.elements() - 1);
}

/// Adds an element's local row to a global one.
template <typename Row>
void scatter(const PlateMesh& mesh, int element, const Eigen::VectorXd& local, Row&& row) {
  for (int j = 0; j < mesh.angular_terms; ++j)
    for (int i = 0; i < 4; ++i) row[mesh.index(element, i, j)] += local[4 * j + i];
}

void scatter(const PlateMesh& mesh, int element, const Eigen::MatrixXd& local, Eigen::MatrixXd& global) {
  for (int j = 0; j < mesh.angular_terms; ++j)
    for (int i = 0; i < 4; ++i)
      for (int l = 0; l < mesh.angular_terms; ++l)
        for (int k = 0; k < 4; ++k)
          global(mesh.index(element, i, j), mesh.index(element, k, l)) += local(4 * j + i, 4 * l + k);
}

}  // namespace

double radial_coordinate(double radius) {
  return std::log(radius) + radius / kEvenRadius;
}

std::vector<double> graded_radii(double inner, double outer, int intervals) {
  const double first = radial_coordinate(inner), step = (radial_coordinate(outer) - first) / intervals;
  std::vector<double> radii = {inner};
  for (int i = 1; i < intervals; ++i) {
    double r = radii.back();
    for (int iteration = 0; iteration < 50; ++iteration)  // Newton in ln r, where the coordinate is convex
      r *= std::exp((first + step * i - radial_coordinate(r)) / (1 + r / kEvenRadius));
    radii.push_back(r);
  }
  radii.push_back(outer);
  return radii;
}

PlateMesh make_plate_mesh(double half_angle, const SolverSettings& settings) {
  return {half_angle, settings.angular_terms,
          graded_radii(settings.inner_radius, settings.outer_radius, settings.radial_elements)};
}

PlatePoint plate_point(const PlateMesh& mesh, int element, double radius, double angle) {
  const auto e = static_cast<std::size_t>(element);
  const HermiteValues n = hermite(mesh.radii[e], mesh.radii[e + 1], radius);
  const std::vector<Legendre> p = even_legendre(angle / mesh.half_angle, mesh.angular_terms);
  const double r = radius, alpha = mesh.half_angle;
  const int size = 4 * mesh.angular_terms;
  PlatePoint at{Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size), Eigen::VectorXd(size)};
  for (int j = 0; j < mesh.angular_terms; ++j) {
    const Legendre& angular = p[static_cast<std::size_t>(j)];
    for (std::size_t i = 0; i < 4; ++i) {
      const int k = 4 * j + static_cast<int>(i);
      at.deflection[k] = n.value[i] * angular.value;
      at.radial_curvature[k] = n.second[i] * angular.value;
      at.hoop_curvature[k] = n.first[i] / r * angular.value + n.value[i] / (r * r) * angular.second / (alpha * alpha);
      at.twisting_curvature[k] = (n.first[i] / r - n.value[i] / (r * r)) * angular.first / alpha;
    }
  }
  return at;
}

PlateMatrices assemble_plate(const PlateMesh& mesh, double poisson_ratio) {
  const double nu = poisson_ratio;
  const std::vector<GaussPoint> angular_rule = even_gauss_rule(mesh.angular_terms + 1);
  PlateMatrices matrices{Eigen::MatrixXd::Zero(mesh.unknowns(), mesh.unknowns()),
                         Eigen::MatrixXd::Zero(mesh.unknowns(), mesh.unknowns())};
  const int size = 4 * mesh.angular_terms;
  for (int e = 0; e < mesh.elements(); ++e) {
    const auto left = static_cast<std::size_t>(e);
    Eigen::MatrixXd bending = Eigen::MatrixXd::Zero(size, size), area = bending;
    for (const auto& [r, radial_weight] : gauss_points(mesh.radii[left], mesh.radii[left + 1])) {
      for (const auto& [x, angular_weight] : angular_rule) {
        const PlatePoint at = plate_point(mesh, e, r, x * mesh.half_angle);
        const double dA = 2 * radial_weight * angular_weight * mesh.half_angle * r;  // both halves
        const auto &kr = at.radial_curvature, &kt = at.hoop_curvature, &krt = at.twisting_curvature;
        bending += dA * (kr * (kr + nu * kt).transpose() + kt * (kt + nu * kr).transpose() +
                         2 * (1 - nu) * krt * krt.transpose());
        area += dA * at.deflection * at.deflection.transpose();
      }
    }
    scatter(mesh, e, bending, matrices.bending);
    scatter(mesh, e, area, matrices.area);
  }
  return matrices;
}

Eigen::VectorXd tip_load(const PlateMesh& mesh, double patch_radius) {
  assert(patch_radius > 0);
  const auto nodes_inside = std::upper_bound(mesh.radii.begin(), mesh.radii.end(), patch_radius) - mesh.radii.begin();
  const auto loaded_nodes = std::min(nodes_inside + 1, static_cast<std::ptrdiff_t>(mesh.radii.size()));
  Eigen::VectorXd load = Eigen::VectorXd::Zero(2 * loaded_nodes);
  // The tip inside of the inner radius r0 continues the mesh along straight rays, w(r) = w(r0) − (r0 − r) w'(r0). Its
  // load is a force and a moment on the innermost node.
  const double inner = mesh.radii.front(), reach = std::min(inner, patch_radius);
  const double inside = (reach / patch_radius) * (reach / patch_radius);  // of the unit force
  const double centroid = 2 * reach / 3;
  load[0] = inside;
  load[1] = -inside * (inner - centroid);
  for (int e = 0; e < mesh.elements(); ++e) {
    const double left = mesh.radii[static_cast<std::size_t>(e)], right = mesh.radii[static_cast<std::size_t>(e) + 1];
    if (left >= patch_radius) break;
    for (const auto& [r, weight] : gauss_points(left, std::min(right, patch_radius))) {
      const HermiteValues n = hermite(left, right, r);
      const double share = weight * 2 * r / (patch_radius * patch_radius);  // of the unit force
      for (int i = 0; i < 4; ++i) load[mesh.index(e, i, 0)] += share * n.value[static_cast<std::size_t>(i)];
    }
  }
  return load;
}

BisectorMoments bisector_moments(const PlateMesh& mesh, double poisson_ratio, double from, double to) {
  BisectorMoments moments;
  for (int e = 0; e < mesh.elements(); ++e) {
    const auto left = static_cast<std::size_t>(e);
    for (const double r : stress_points(mesh.radii[left], mesh.radii[left + 1]))
      if (r >= from && r <= to) moments.radii.push_back(r);
  }
  const auto points = static_cast<Eigen::Index>(moments.radii.size());
  moments.radial = moments.hoop = Eigen::MatrixXd::Zero(points, mesh.unknowns());
  for (Eigen::Index row = 0; row < points; ++row) {
    const double r = moments.radii[static_cast<std::size_t>(row)];
    const int e = element_at(mesh, r);
    const PlatePoint at = plate_point(mesh, e, r, 0);
    scatter(mesh, e, Eigen::VectorXd(at.radial_curvature + poisson_ratio * at.hoop_curvature), moments.radial.row(row));
    scatter(mesh, e, Eigen::VectorXd(-at.hoop_curvature - poisson_ratio * at.radial_curvature), moments.hoop.row(row));
  }
  return moments;
}

Eigen::MatrixXd deflection_rows(const PlateMesh& mesh, const std::vector<double>& radii,
                                const std::vector<double>& angles) {
  Eigen::MatrixXd rows = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(radii.size()), mesh.unknowns());
  for (std::size_t k = 0; k < radii.size(); ++k) {
    const int e = element_at(mesh, radii[k]);
    scatter(mesh, e, plate_point(mesh, e, radii[k], angles[k]).deflection, rows.row(static_cast<Eigen::Index>(k)));
  }
  return rows;
}

}  // namespace polynya::fracture
