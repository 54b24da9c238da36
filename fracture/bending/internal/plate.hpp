#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include <Eigen/Dense>
#include <boost/math/quadrature/gauss.hpp>

#include "fracture/bending/solver_settings.hpp"

namespace polynya::fracture {

/// The four cubic Hermite shape functions of an element [left, right] at a point, with their derivatives. They belong
/// to the deflection and the slope at the left node, then at the right node.
struct HermiteValues {
  std::array<double, 4> value;   ///< N
  std::array<double, 4> first;   ///< N' [1/length]
  std::array<double, 4> second;  ///< N'' [1/length²]
};

inline HermiteValues hermite(double left, double right, double point) {
  const double h = right - left;
  const double s = (point - left) / h;
  const double s2 = s * s, s3 = s2 * s;
  return {{1 - 3 * s2 + 2 * s3, h * (s - 2 * s2 + s3), 3 * s2 - 2 * s3, h * (s3 - s2)},
          {(6 * s2 - 6 * s) / h, 1 - 4 * s + 3 * s2, (6 * s - 6 * s2) / h, 3 * s2 - 2 * s},
          {(12 * s - 6) / (h * h), (6 * s - 4) / h, (6 - 12 * s) / (h * h), (6 * s - 2) / h}};
}

struct GaussPoint {
  double point;
  double weight;
};

/// Returns the five-point Gauss–Legendre rule on [left, right], exact to degree nine.
inline std::array<GaussPoint, 5> gauss_points(double left, double right) {
  using Rule = boost::math::quadrature::gauss<double, 5>;  // the points from the middle outwards
  const auto& offsets = Rule::abscissa();
  const auto& weights = Rule::weights();
  const double middle = 0.5 * (left + right), half = 0.5 * (right - left);
  const auto at = [&](double side, std::size_t i) {
    return GaussPoint{middle + side * half * offsets[i], half * weights[i]};
  };
  return {at(-1, 2), at(-1, 1), at(1, 0), at(1, 1), at(1, 2)};
}

/// Returns the two Gauss points of a cubic element, at which its curvature converges one order faster than elsewhere.
inline std::array<double, 2> stress_points(double left, double right) {
  const double middle = 0.5 * (left + right), offset = 0.5 * (right - left) / std::sqrt(3.0);
  return {middle - offset, middle + offset};
}

/// The finite elements of a wedge-shaped plate, symmetric about its bisector θ = 0, all four edges free:
///   w(r, θ) = Σ_ij N_i(r) P_2j(θ/α) x_ij,   N_i cubic Hermite in r, P_2j even Legendre in θ/α
/// All lengths are in l, deflections in P / (ρ_w g l²), moments per width in P.
struct PlateMesh {
  double half_angle = 0;      ///< α [rad]
  int angular_terms = 0;      ///< number of even Legendre polynomials
  std::vector<double> radii;  ///< nodes, ascending

  int elements() const { return static_cast<int>(radii.size()) - 1; }
  int radial_unknowns() const { return 2 * static_cast<int>(radii.size()); }
  int unknowns() const { return radial_unknowns() * angular_terms; }
  /// Returns the place of unknown i (0..3: deflection, slope, deflection, slope) of an element in angular term j.
  int index(int element, int i, int j) const { return j * radial_unknowns() + 2 * element + i; }
};

PlateMesh make_plate_mesh(double half_angle, const SolverSettings& settings);

/// Returns the coordinate in which the mesh is evenly spaced, ln r + r / 2: geometric near the tip and even far from
/// it. r is in l.
double radial_coordinate(double radius);

/// Returns radii from `inner` to `outer` at equal steps of radial_coordinate().
std::vector<double> graded_radii(double inner, double outer, int intervals);

/// The shape functions of an element at one point: the deflection and its curvatures per unknown. Their length is 4 ·
/// terms, with unknown i of angular term j at 4j + i.
struct PlatePoint {
  Eigen::VectorXd deflection;          ///< w
  Eigen::VectorXd radial_curvature;    ///< κ_r = w_rr
  Eigen::VectorXd hoop_curvature;      ///< κ_θ = w_r / r + w_θθ / r²
  Eigen::VectorXd twisting_curvature;  ///< κ_rθ = w_rθ / r − w_θ / r²
};

PlatePoint plate_point(const PlateMesh& mesh, int element, double radius, double angle);

/// The bending energy and the area of the whole wedge as quadratic forms:
///   xᵀ B x = ∫ κ_r² + κ_θ² + 2ν κ_r κ_θ + 2(1−ν) κ_rθ² dA,   xᵀ A x = ∫ w² dA
/// Buoyancy therefore has the stiffness A, and the ice the mass m̂ A. [Timoshenko1959, ch. 10, polar form]
struct PlateMatrices {
  Eigen::MatrixXd bending;  ///< B
  Eigen::MatrixXd area;     ///< A
};

PlateMatrices assemble_plate(const PlateMesh& mesh, double poisson_ratio);

/// Returns the generalised load of a unit force that is spread evenly over the tip sector r < patch_radius. It does not
/// vary with θ, so only the first angular term is loaded; the entries of this term up to the last loaded node are
/// returned. Load inside the mesh's inner radius r0 acts on the innermost node with its force and its moment about r0.
/// Without the moment a patch smaller than r0 would act as one of 1.5 r0, and a narrow wedge would break up to a third
/// too far out.
Eigen::VectorXd tip_load(const PlateMesh& mesh, double patch_radius);

/// Moments per width on the bisector, one row per point, at the points where they are most accurate.
struct BisectorMoments {
  std::vector<double> radii;  ///< ascending
  Eigen::MatrixXd radial;     ///< κ_r + ν κ_θ: tension in the top fibre where positive
  Eigen::MatrixXd hoop;       ///< −(κ_θ + ν κ_r): tension in the bottom fibre where positive
};

/// Returns the moments between the radii `from` and `to`.
BisectorMoments bisector_moments(const PlateMesh& mesh, double poisson_ratio, double from, double to);

/// Returns the deflections at points (radius, angle), one row per point.
Eigen::MatrixXd deflection_rows(const PlateMesh& mesh, const std::vector<double>& radii,
                                const std::vector<double>& angles);

}  // namespace polynya::fracture
