#pragma once

#include "dynamics/planar.hpp"

namespace polynya::dynamics {
// Propellers behind a hull: what they push with, at rest and under way.

/// A ship's propellers and what drives them. The thrust lever is a share of the power, from −1 (full astern)
/// to 1 (full ahead).
struct Engine {
  double bollard_pull = 0;      ///< T_B, of all propellers at rest, full ahead [N]
  double open_water_speed = 0;  ///< v_ow, full ahead in open water [m/s]
  double astern_share = 0.65;   ///< of the bollard pull, full astern [-]
  double lever_rate = 0.033;    ///< of the lever [1/s]
  double power = 0;             ///< installed, of all propellers; 0: not known [W]
  double propeller_area = 0;    ///< of all propellers' discs [m²]
  int propellers = 1;           ///< number of propellers [-]
  bool has_nozzles = false;     ///< the propellers are ducted
  friend bool operator==(const Engine&, const Engine&) = default;
};

/// K_e (P D)^⅔ with P in kW, D in m: K_e .78, .98, 1.12 kN for 1, 2, 3 propellers (the bollard form of the
/// Finnish-Swedish ice class rules' K_e, as 1.4 times as much with nozzles, recall) [N]. Power [W] of all
/// propellers, diameter [m] of one.
double bollard_pull(double power, double diameter, int propellers, bool has_nozzles = false);

/// Thrust at a lever: |λ|^⅔ T_B ahead, the astern share of it astern [N].
double thrust_at(const Engine& engine, double lever);

/// The net-thrust law of a ship under way, T_B [1 − v/(3 v_ow) − ⅔ (v/v_ow)²] full ahead in open water, in
/// its two parts. The propellers lose thrust in proportion to the speed that they go ahead with; the rest is
/// the hull's resistance, which is ⅔ T_B at v_ow.
double propeller_thrust(const Engine& engine, double lever, double speed);  ///< [N]
double quadratic_resistance(const Engine& engine);                          ///< [N s²/m²]

/// Thrust at a lever less what the water takes at a speed ahead [m/s]: what is left to break ice [N].
double net_thrust(const Engine& engine, double lever, double speed);

/// A setting that goes to a wanted one at a rate, after a time dt [s].
double approach(double setting, double wanted, double rate, double dt);

/// Force of a thrust [N] that is turned by an angle [rad], to port if positive, at x [m].
Planar turned_thrust(double thrust, double angle, double x);

}  // namespace polynya::dynamics
