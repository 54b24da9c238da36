#pragma once

#include "dynamics/planar.hpp"

namespace polynya::dynamics {
// The thrust of propellers behind a hull, at rest and under way.

/// The propellers of a ship and their engine. The thrust lever is a fraction of the power, from −1 (full astern) to 1
/// (full ahead).
struct Engine {
  double bollard_pull = 0;      ///< T_B, of all propellers at rest, full ahead [N]
  double open_water_speed = 0;  ///< v_ow, full ahead in open water [m/s]
  double astern_share = 0.65;   ///< thrust full astern over the bollard pull [-]
  double lever_rate = 0.033;    ///< rate at which the lever moves [1/s]
  double power = 0;             ///< installed power of all propellers; 0: not known [W]
  double propeller_area = 0;    ///< of all propellers' discs [m²]
  int propellers = 1;           ///< number of propellers [-]
  bool has_nozzles = false;     ///< the propellers are ducted
  friend bool operator==(const Engine&, const Engine&) = default;
};

/// Returns the bollard pull K_e (P D)^⅔ with P in kW and D in m [N]. K_e is 0.78, 0.98 and 1.12 kN for 1, 2 and 3
/// propellers: the bollard form of K_e in the Finnish-Swedish ice class rules; 1.4 times as much with nozzles (recall).
/// `power` is of all propellers [W], `diameter` of one [m].
double bollard_pull(double power, double diameter, int propellers, bool has_nozzles = false);

/// Returns the thrust at a lever: |λ|^⅔ T_B ahead, multiplied by the astern share astern [N].
double thrust_at(const Engine& engine, double lever);

/// The net-thrust law of a ship under way, T_B [1 − v/(3 v_ow) − ⅔ (v/v_ow)²] full ahead in open water, in its two
/// parts. The thrust of the propellers falls in proportion to the speed ahead; the rest is the resistance of the hull,
/// which is ⅔ T_B at v_ow.
double propeller_thrust(const Engine& engine, double lever, double speed);  ///< [N]
double quadratic_resistance(const Engine& engine);                          ///< [N s²/m²]

/// Returns the thrust at a lever minus the resistance of the water at a speed ahead [m/s]: the force left to break ice
/// [N].
double net_thrust(const Engine& engine, double lever, double speed);

/// Returns a setting that has moved towards a wanted one at a rate for a time dt [s].
double approach(double setting, double wanted, double rate, double dt);

/// Returns the force of a thrust [N] that is turned by an angle [rad], to port if positive, at x [m].
Planar turned_thrust(double thrust, double angle, double x);

}  // namespace polynya::dynamics
