#pragma once

#include <cstdint>

namespace polynya::fracture {

/// The models of the water's dynamic pressure on a plate; buoyancy is always included.
enum class FluidModel : std::uint8_t {
  kWinkler,      ///< no dynamic pressure: springs only
  kLocalMass,    ///< an added mass c ρ_w l per area, moving with the point above it
  kPotential,    ///< linear potential flow, φ = 0 on the open water beside the plate
  kFreeSurface,  ///< linear potential flow with gravity waves, φ_t + g η = 0 on the open water
};

/// The discretisation of a wedge of floating ice. Lengths are divided by the characteristic length l. More elements,
/// terms, panels or steps, and a smaller inner or larger outer radius, reduce the error and take more time. The shipped
/// database has these values; docs/theory/bending.md, "Accuracy", states its errors.
struct SolverSettings {
  FluidModel fluid = FluidModel::kPotential;
  double poisson_ratio = 0.3;     ///< ν [-]
  double local_mass = 0.5;        ///< c of FluidModel::kLocalMass [-]
  double inner_radius = 0.001;    ///< r0, where the plate's mesh starts [-]
  double outer_radius = 8;        ///< where the mesh ends; that edge is free [-]
  int radial_elements = 36;       ///< cubic Hermite elements
  int angular_terms = 5;          ///< even Legendre polynomials across the wedge
  int panel_rings = 72;           ///< fluid panels along the radius; a multiple of radial_elements aligns both meshes
  int panel_columns = 6;          ///< fluid panels across the half wedge
  int free_surface_columns = 10;  ///< fluid panels across the half of the open water, kFreeSurface only
  int steps_to_failure = 60;      ///< time steps to the break of a slow push; a fast push breaks later and takes more

  friend bool operator==(const SolverSettings&, const SolverSettings&) = default;
};

}  // namespace polynya::fracture
