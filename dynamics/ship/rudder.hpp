#pragma once

#include "dynamics/planar.hpp"

namespace polynya::dynamics {

// What turns a ship at its stern. A positive angle turns a ship that goes ahead to port.

/// A rudder behind a propeller.
struct Rudder {
  double area = 0;                  ///< A_R [m²]
  double aspect_ratio = 1.5;        ///< Λ, height over chord [-]
  double position = 0;              ///< x_R from the centre of gravity [m]
  double race_area = 0;             ///< A_P of the propellers' discs; 0: no race [m²]
  double wake_fraction = 0.2;       ///< w: the hull carries that share of its speed along [-]
  double race_coefficient = 1;      ///< C; 1: the race of an actuator disc, fully contracted [-]
  double flow_straightening = 0.6;  ///< γ: by the hull, of the flow's angle at the stern [-]
  double hull_factor = 0.3;         ///< a_H: side force of the hull over that of the rudder [-]
};

/// Force on the ship of a rudder at an angle [rad], ν through the water, the propellers' thrust ahead [N], in
/// water of a density [kg/m³]. The axial flow is that of hull and race,
///   U_R² = (1 − w)² u² + R,   R = C 2T/(ρ A_P),
/// the blade's normal force
///   F_N = ½ρ A_R f_α U_R² sin(δ + γ atan((v + x_R r)/√(u² + .02 R))),   f_α = 6.13 Λ/(Λ + 2.25),
/// −F_N sin δ along the ship, −(1 + a_H) F_N cos δ across it at x_R. The .02 R keep the flow's angle from
/// jumping where a ship hardly moves. Going astern the flow comes from behind, and the race of a thrust
/// astern goes ahead.
Planar rudder_force(const Rudder& rudder, double angle, Planar through_water, double thrust, double density);

/// Force of a thrust [N] that is turned by an angle [rad] at x [m].
Planar turned_thrust(double thrust, double angle, double x);

}  // namespace polynya::dynamics
