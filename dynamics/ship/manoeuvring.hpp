#pragma once

#include "dynamics/planar.hpp"

namespace polynya::dynamics {

// The water around a hull that moves in surge, sway and yaw.

/// A hull's main dimensions in the water.
struct MainDimensions {
  double length = 0;             ///< L of the waterline [m]
  double beam = 0;               ///< B [m]
  double draught = 0;            ///< T [m]
  double block_coefficient = 0;  ///< C_B = displaced volume / (L B T) [-]
};

/// Linear derivatives of the force and moment of the water, without dimension: by ½ρL² U (Y_v), ½ρL³ U (Y_r,
/// N_v), ½ρL⁴ U (N_r), and ½ρL³ (Y_v̇), ½ρL⁴ (Y_ṙ, N_v̇), ½ρL⁵ (N_ṙ). They are total ones: the Munk moment and
/// the added mass's Coriolis force are in them, the rigid body's m U r is not.
struct ManoeuvringDerivatives {
  double y_v_dot = 0;
  double y_r_dot = 0;
  double n_v_dot = 0;
  double n_r_dot = 0;
  double y_v = 0;
  double y_r = 0;
  double n_v = 0;
  double n_r = 0;

  /// Whether they take energy from every motion, and the added mass has inertia in every direction. Outside
  /// of the hulls that the regression was made from they need not.
  bool are_physical() const;
};

/// The regression of [ClarkeGedlingHine1983], of merchant hulls on an even keel in deep water.
ManoeuvringDerivatives clarke_derivatives(const MainDimensions& hull);

/// 1.7 L T + ∇/T, the wetted surface by Mumford's formula (recall) [m²].
double wetted_surface(const MainDimensions& hull);

/// A hull in water as a step needs it.
struct HullInWater {
  double density = 1000;  ///< of the water [kg/m³]
  double length = 0;      ///< L of the waterline [m]
  double draught = 0;     ///< T [m]
  double aft = 0;         ///< x of the waterline's ends from the centre of gravity [m]
  double fore = 0;
  double cross_flow_drag = 0;       ///< C_d of the flow across the hull [-]
  double quadratic_resistance = 0;  ///< ahead, over the speed's square [N s²/m²]
  ManoeuvringDerivatives derivatives;
  PlanarMatrix added_mass;  ///< symmetric, no negative energy
};

/// The added mass of a hull: ½ρL³ and so on times −Y_v̇, −N_ṙ, and in surge what is given [kg]. The coupling
/// of sway and yaw is the mean of −Y_ṙ and −N_v̇, which the regression gives apart and which no energy can
/// have apart; it is held below where the added mass would have a negative energy.
PlanarMatrix added_mass_of(const ManoeuvringDerivatives& derivatives, double length, double density, double in_surge);

/// D(ν) of the force of the water −D(ν) ν on a hull that moves at ν through it, without added mass [N s/m …].
/// Three laws: the resistance ahead; the linear derivatives, of which those that damp scale with |u| and
/// those that couple sway and yaw with u, since a hull that goes astern is the hull's mirror image, and since
/// with U = |ν| they would brake a ship that drifts sideways as if it sailed; and the cross flow, which is
/// left when the hull does not move ahead,
///   Y = −½ρ T C_d ∫|v + x r| (v + x r) dx,   N the same with x.
/// ν·D(ν)ν ≥ 0 (are_physical), and so for any other velocity than the one that D is taken at.
PlanarMatrix water_damping(const HullInWater& hull, Planar through_water);

}  // namespace polynya::dynamics
