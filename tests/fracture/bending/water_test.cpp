// The water under the plate: added mass of a disc, a floating disc's heave, flexural-gravity waves.
#include <cmath>
#include <numbers>
#include <utility>

#include <gtest/gtest.h>

#include "fracture/bending/internal/fluid.hpp"
#include "fracture/bending/internal/modes.hpp"

namespace polynya::fracture {
namespace {

constexpr double kPi = std::numbers::pi;

std::vector<double> even_rays(double edge, int columns) {
  std::vector<double> rays;
  for (int j = 0; j <= 2 * columns; ++j) rays.push_back(0.5 * edge * j / columns);
  return rays;
}

/// A unit disc whose rings draw together towards its edge.
double heaving_disc_added_mass(int rings) {
  const PanelMesh mesh = make_panel_mesh(rays_towards_edge(0, 1, rings), even_rays(kPi, 8));
  return added_mass(mesh).sum();
}

// One side of a disc heaving in unbounded water, 4/3 ρ a³ [Lamb1932].
TEST(Water, HeavingDiscAddedMass) {
  double previous = 1;
  for (const int rings : {8, 16, 32}) {
    const double error = std::abs(heaving_disc_added_mass(rings) - 4.0 / 3);
    EXPECT_LT(error, 0.6 * previous) << rings;
    previous = error;
  }
  EXPECT_LT(previous, 0.006);
}

// Added mass of a pitching disc, one side: 8/45 ρ a⁵ [Lamb1932]; 16/45 for both.
TEST(Water, PitchingDiscAddedMass) {
  for (const auto& [rings, tolerance] : {std::pair{8, 4e-3}, {16, 1e-3}, {32, 5e-4}}) {
    const PanelMesh mesh = make_panel_mesh(rays_towards_edge(0, 1, rings), even_rays(kPi, 12));
    Eigen::VectorXd velocity(mesh.size());  // about the y axis, symmetric about θ = 0
    for (int i = 0; i < mesh.size(); ++i)
      velocity[i] =
          mesh.radii[static_cast<std::size_t>(i)] * std::cos(mesh.angles[static_cast<std::size_t>(i)]);
    EXPECT_NEAR(velocity.dot(added_mass(mesh) * velocity), 8.0 / 45, tolerance) << rings;
  }
}

// A small free disc bobs rigidly: μ = 1/ω² = m̂ + 4R/3π, of all modes the slowest. Plate, water and modes
// together.
TEST(Water, SmallDiscHeaves) {
  const double mass_ratio = 0.05, radius = 0.2;
  double previous = 1;
  for (const int rings : {32, 64, 128}) {
    SolverSettings settings;
    settings.angular_terms = 1;
    settings.inner_radius = 1e-3;
    settings.outer_radius = radius;
    settings.panel_rings = rings;
    settings.panel_columns = 4;
    const double error = std::abs(wedge_modes(kPi, mass_ratio, settings).inertia.maxCoeff() /
                                      (mass_ratio + 4 * radius / (3 * kPi)) -
                                  1);
    EXPECT_LT(error, 0.6 * previous) << rings;
    previous = error;
  }
  EXPECT_LT(previous, 0.03);
}

/// Wave number k of the J0(kr) that fits samples of a mode best, by a scan and a golden section.
double fitted_wave_number(const std::vector<double>& radii, const Eigen::VectorXd& values, double least,
                          double most) {
  const auto misfit = [&](double k) {
    double vj = 0, jj = 0, vv = 0;
    for (std::size_t i = 0; i < radii.size(); ++i) {
      const double j = std::cyl_bessel_j(0.0, k * radii[i]), v = values[static_cast<Eigen::Index>(i)],
                   r = radii[i];
      vj += r * v * j;
      jj += r * j * j;
      vv += r * v * v;
    }
    return 1 - vj * vj / (jj * vv);
  };
  double best = least;
  for (double k = least; k < most; k *= 1.01)
    if (misfit(k) < misfit(best)) best = k;
  double low = best / 1.01, high = best * 1.01;
  for (int i = 0; i < 60; ++i) {
    const double a = low + 0.382 * (high - low), b = low + 0.618 * (high - low);
    (misfit(a) < misfit(b) ? high : low) = misfit(a) < misfit(b) ? b : a;
  }
  return misfit(best) < 0.02 ? 0.5 * (low + high) : 0;
}

/// Worst relative error of ω² against ω² = (k⁵ + k) / (1 + m̂ k) over the axisymmetric modes of a large disc
/// whose interior is a standing wave, 1 ≤ k ≤ 4; -1 with fewer than five such modes.
double dispersion_error(int elements, int rings) {
  SolverSettings settings;
  settings.angular_terms = 1;
  settings.radial_elements = elements;
  settings.panel_rings = rings;
  settings.panel_columns = 6;
  const double mass_ratio = 0.1;
  const PlateMesh mesh = make_plate_mesh(kPi, settings);
  const WedgeMatrices wedge = assemble_wedge(mesh, mass_ratio, settings);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(wedge.mass, wedge.stiffness);
  std::vector<double> radii, angles;
  for (double r = 0.05; r < 5.5; r += 0.05) {
    radii.push_back(r);
    angles.push_back(0);
  }
  const Eigen::MatrixXd shapes = deflection_rows(mesh, radii, angles) * solver.eigenvectors();
  double worst = 0;
  int waves = 0;
  for (Eigen::Index mode = 0; mode < shapes.cols(); ++mode) {
    const double k = fitted_wave_number(radii, shapes.col(mode), 0.9, 4.5);
    if (k < 1 || k > 4) continue;
    const double omega_squared = 1 / solver.eigenvalues()[mode];
    worst = std::max(worst, std::abs(omega_squared * (1 + mass_ratio * k) / (std::pow(k, 5) + k) - 1));
    ++waves;
  }
  return waves >= 5 ? worst : -1;
}

// Waves of an infinite floating plate over deep water [Greenhill1886].
TEST(Water, FlexuralGravityWavesDisperse) {
  const double coarse = dispersion_error(36, 32), fine = dispersion_error(54, 64);
  ASSERT_GT(coarse, 0);
  ASSERT_GT(fine, 0);
  EXPECT_LT(fine, coarse);
  EXPECT_LT(fine, 0.05);
}

TEST(Water, AddedMassIsSymmetricAndPositive) {
  const PanelMesh mesh = make_panel_mesh(graded_radii(0.01, 4, 24), rays_towards_edge(0, 1, 5));
  const Eigen::MatrixXd mass = added_mass(mesh);
  ASSERT_EQ(mass.rows(), mesh.size());
  EXPECT_LT((mass - mass.transpose()).norm(), 1e-12 * mass.norm());
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(mass).eigenvalues().minCoeff(), 0);
}

}  // namespace
}  // namespace polynya::fracture
