#pragma once

#include "dynamics/planar.hpp"

namespace polynya::dynamics {

// The forces of water on a hull that moves in surge, sway and yaw.

/// The main dimensions of a hull in water.
struct MainDimensions {
  double length = 0;             ///< L of the waterline [m]
  double beam = 0;               ///< B [m]
  double draught = 0;            ///< T [m]
  double block_coefficient = 0;  ///< C_B = displaced volume / (L B T) [-]
};

/// Linear derivatives of the force and moment of the water, made dimensionless by ½ρL² U (Y_v), ½ρL³ U (Y_r, N_v), ½ρL⁴
/// U (N_r), ½ρL³ (Y_v̇), ½ρL⁴ (Y_ṙ, N_v̇) and ½ρL⁵ (N_ṙ). They are total derivatives: they contain the Munk moment and
/// the Coriolis force of the added mass, but not the rigid body's m U r.
struct ManoeuvringDerivatives {
  double y_v_dot = 0;
  double y_r_dot = 0;
  double n_v_dot = 0;
  double n_r_dot = 0;
  double y_v = 0;
  double y_r = 0;
  double n_v = 0;
  double n_r = 0;

  /// Returns true if the derivatives take energy from every motion and the added mass is positive in every direction.
  /// It may be false outside of the regression.
  bool are_physical() const;
};

/// Returns the derivatives by the regression of [ClarkeGedlingHine1983], for merchant hulls on an even keel in deep
/// water.
ManoeuvringDerivatives clarke_derivatives(const MainDimensions& hull);

/// Returns the wetted surface by Mumford's formula, 1.7 L T + ∇/T (recall) [m²].
double wetted_surface(const MainDimensions& hull);

/// The data of a hull in water that a step needs.
struct HullInWater {
  double density = 1000;  ///< of the water [kg/m³]
  double length = 0;      ///< L of the waterline [m]
  double draught = 0;     ///< T [m]
  double aft = 0;         ///< x of the after end of the waterline from the centre of gravity [m]
  double fore = 0;
  double cross_flow_drag = 0;       ///< C_d of the flow across the hull [-]
  double quadratic_resistance = 0;  ///< resistance ahead, divided by the square of the speed [N s²/m²]
  ManoeuvringDerivatives derivatives;
  PlanarMatrix added_mass;  ///< symmetric and positive semidefinite
};

/// Returns the added mass of a hull: ½ρL³ etc. times −Y_v̇ and −N_ṙ, and the given value in surge [kg]. The coupling of
/// sway and yaw is the mean of −Y_ṙ and −N_v̇. The regression gives two different values, which would create energy.
/// The coupling is limited so that the energy of the added mass is not negative.
PlanarMatrix added_mass_of(const ManoeuvringDerivatives& derivatives, double length, double density, double in_surge);

/// Returns the damping D(ν) of the force of the water, −D(ν) ν, on a hull that moves at ν through it, without added
/// mass [N s/m …]. It has three parts: the resistance ahead; the linear derivatives; and the cross flow, which remains
/// when the hull does not move ahead,
///   Y = −½ρ T C_d ∫|v + x r| (v + x r) dx,   N the same with x.
/// Linear derivatives that damp scale with |u|, and couplings of sway and yaw scale with u, because a hull that
/// goes astern is the mirror image of the hull. With U = |ν| instead, they would brake a ship that drifts sideways as
/// if it were under way.
/// ν·D(ν)ν ≥ 0 (are_physical), and the same holds for any other velocity than the one at which D is taken.
PlanarMatrix water_damping(const HullInWater& hull, Planar through_water);

}  // namespace polynya::dynamics
