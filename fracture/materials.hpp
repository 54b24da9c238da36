#pragma once

namespace polynya::fracture {

/// Ice properties that the fracture laws need. Defaults are the paper's ice [Sawamura2017]; the paper gives no ν.
struct Ice {
  double thickness = 0.5;               ///< h [m]
  double density = 900;                 ///< ρ_i [kg/m³]
  double youngs_modulus = 5.4e9;        ///< E [Pa]
  double poisson_ratio = 0.3;           ///< ν [-]
  double flexural_strength = 0.8e6;     ///< σ_f [Pa]
  double compressive_strength = 2.8e6;  ///< σ_c [Pa]
  double tensile_strength = 0.8e6;      ///< σ_t [Pa]
  double fracture_toughness = 150e3;    ///< K_IC [Pa √m]
  double friction = 0.2;                ///< μ, hull on ice and ice on ice [-]
  friend bool operator==(const Ice&, const Ice&) = default;
};

struct Water {
  double density = 1000;  ///< ρ_w [kg/m³]
  friend bool operator==(const Water&, const Water&) = default;
};

inline constexpr double kGravity = 9.81;  ///< g [m/s²]

/// Returns the flexural rigidity of a plate, D = E h³ / 12(1 − ν²) [N m].
inline double flexural_rigidity(const Ice& ice) {
  return ice.youngs_modulus * ice.thickness * ice.thickness * ice.thickness /
         (12 * (1 - ice.poisson_ratio * ice.poisson_ratio));
}

}  // namespace polynya::fracture
