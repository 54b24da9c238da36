#pragma once

#include <vector>

#include <Eigen/Dense>

namespace polynya::fracture {

/// Flat fluid panels between rings and rays of the plane z = 0, for 0 ≤ θ. Each panel represents itself and its mirror
/// image at −θ. Lengths are in l.
struct PanelMesh {
  std::vector<double> rings;   ///< radii of the panels' borders, ascending
  std::vector<double> rays;    ///< angles of the panels' borders, ascending from 0 [rad]
  std::vector<double> radii;   ///< radii of the panels' control points, ring by ring
  std::vector<double> angles;  ///< angles of the panels' control points [rad]
  Eigen::VectorXd areas;       ///< area of each panel and its image together

  int size() const { return static_cast<int>(radii.size()); }
};

/// Makes panels between every second ring and ray, with their control points on the rings and rays between; both lists
/// have an odd number of ascending values. Control points at the middle of the spacing's parameter, rather than at the
/// panel's centroid, make a vortex lattice accurate at its free edge.
PanelMesh make_panel_mesh(const std::vector<double>& rings_and_controls, const std::vector<double>& rays_and_controls);

/// Returns the rays and controls of `columns` panels from angle `from` to the plate's edge at angle `edge` [rad]. They
/// are denser towards the edge, where the potential behaves as the square root of the distance.
std::vector<double> rays_towards_edge(double from, double edge, int columns);

/// Returns the flux matrix N, made symmetric: [N ψ]_i = ∫ ∂ψ/∂z dA. Its element (i, j) is the upward fluid velocity at
/// panel i, for a unit potential under panel j and zero elsewhere on z = 0, times the area of panel i. The odd
/// continuation of the potential over z = 0 is a layer of doublets. A panel of constant doublet strength is a vortex
/// ring along its border, and the Biot–Savart law gives the velocity [Katz2001, §10.4].
Eigen::MatrixXd surface_flux(const PanelMesh& mesh);

/// Returns the added mass of the water under the panels, in ρ_w l³: the kinetic energy of the flow that moves the water
/// surface of each panel at the velocity u_i is ½ uᵀ S N⁻¹ S u, with the diagonal matrix S of the areas. One-sided
/// potential flow with φ = 0 on z = 0 outside of the panels. Empty if N is not positive definite, for example for an
/// unusable mesh.
Eigen::MatrixXd added_mass(const PanelMesh& mesh);

}  // namespace polynya::fracture
