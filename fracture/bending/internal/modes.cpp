#include "fracture/bending/internal/modes.hpp"

#include <cassert>
#include <numbers>

#include <Eigen/Eigenvalues>

#include "fracture/bending/internal/fluid.hpp"

namespace polynya::fracture {
namespace {

std::vector<double> fluid_rings(const SolverSettings& settings) {
  return graded_radii(settings.inner_radius, settings.outer_radius, 2 * settings.panel_rings);
}

/// Returns F = Wᵀ (added mass of the panels) W, with the plate's deflection W at the panels' control points.
Eigen::MatrixXd potential_added_mass(const PlateMesh& mesh, const SolverSettings& settings) {
  const PanelMesh panels =
      make_panel_mesh(fluid_rings(settings), rays_towards_edge(0, mesh.half_angle, settings.panel_columns));
  const Eigen::MatrixXd deflection = deflection_rows(mesh, panels.radii, panels.angles);
  return deflection.transpose() * added_mass(panels) * deflection;
}

/// Returns the matrices with panels on the open water beside the wedge too. Their elevations are unknowns that have the
/// mass of the fluid and the stiffness of their own weight, which is φ_t + g η = 0 on the open water.
WedgeMatrices with_free_surface(const PlateMesh& mesh, const WedgeMatrices& plate, const SolverSettings& settings) {
  std::vector<double> rays = rays_towards_edge(0, mesh.half_angle, settings.panel_columns);
  const std::vector<double> open = rays_towards_edge(std::numbers::pi, mesh.half_angle, settings.free_surface_columns);
  rays.insert(rays.end(), open.rbegin() + 1, open.rend());
  const PanelMesh panels = make_panel_mesh(fluid_rings(settings), rays);

  const Eigen::Index plate_size = mesh.unknowns();
  std::vector<int> open_water;
  for (int i = 0; i < panels.size(); ++i)
    if (panels.angles[static_cast<std::size_t>(i)] > mesh.half_angle) open_water.push_back(i);
  const Eigen::Index size = plate_size + static_cast<Eigen::Index>(open_water.size());
  Eigen::MatrixXd surface = Eigen::MatrixXd::Zero(panels.size(), size);  // surface elevations from the unknowns
  for (int i = 0; i < panels.size(); ++i) {
    const auto k = static_cast<std::size_t>(i);
    if (panels.angles[k] <= mesh.half_angle)
      surface.row(i).head(plate_size) = deflection_rows(mesh, {panels.radii[k]}, {panels.angles[k]});
  }
  WedgeMatrices all{Eigen::MatrixXd::Zero(size, size), Eigen::MatrixXd::Zero(size, size)};
  all.stiffness.topLeftCorner(plate_size, plate_size) = plate.stiffness;
  for (std::size_t k = 0; k < open_water.size(); ++k) {
    const Eigen::Index unknown = plate_size + static_cast<Eigen::Index>(k);
    surface(open_water[k], unknown) = 1;
    all.stiffness(unknown, unknown) = panels.areas[open_water[k]];
  }
  all.mass = surface.transpose() * added_mass(panels) * surface;
  all.mass.topLeftCorner(plate_size, plate_size) += plate.mass;
  return all;
}

}  // namespace

WedgeMatrices assemble_wedge(const PlateMesh& mesh, double mass_ratio, const SolverSettings& settings) {
  const PlateMatrices plate = assemble_plate(mesh, settings.poisson_ratio);
  WedgeMatrices wedge{mass_ratio * plate.area, plate.bending + plate.area};
  switch (settings.fluid) {
    case FluidModel::kWinkler:
      break;
    case FluidModel::kLocalMass:
      wedge.mass += settings.local_mass * plate.area;
      break;
    case FluidModel::kPotential:
      wedge.mass += potential_added_mass(mesh, settings);
      break;
    case FluidModel::kFreeSurface:
      wedge = with_free_surface(mesh, wedge, settings);
      break;
  }
  return wedge;
}

WedgeModes wedge_modes(double half_angle, double mass_ratio, const SolverSettings& settings) {
  WedgeModes modes;
  modes.mesh = make_plate_mesh(half_angle, settings);
  const WedgeMatrices wedge = assemble_wedge(modes.mesh, mass_ratio, settings);
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(wedge.mass, wedge.stiffness);
  assert(solver.info() == Eigen::Success);
  modes.inertia = solver.eigenvalues().cwiseMax(0);
  const auto moments_from = [&](double first) {
    return bisector_moments(modes.mesh, settings.poisson_ratio, first, kLastRadius);
  };
  const BisectorMoments top = moments_from(kFirstTopRadius * settings.inner_radius);
  const BisectorMoments bottom = moments_from(kFirstBottomRadius);
  const auto shapes = solver.eigenvectors().topRows(modes.mesh.unknowns());
  modes.load_shapes = shapes.topRows(modes.mesh.radial_unknowns()).transpose();
  modes.radii = top.radii;
  modes.radial_moment = top.radial * shapes;
  modes.hoop_radii = bottom.radii;
  modes.hoop_moment = bottom.hoop * shapes;
  modes.tip = (deflection_rows(modes.mesh, {settings.inner_radius}, {0}) * shapes).transpose();
  return modes;
}

Eigen::VectorXd static_amplitudes(const WedgeModes& modes, double patch_radius) {
  const Eigen::VectorXd load = tip_load(modes.mesh, patch_radius);
  return modes.load_shapes.leftCols(load.size()) * load;
}

}  // namespace polynya::fracture
