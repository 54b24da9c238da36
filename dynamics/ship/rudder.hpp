#pragma once

#include "dynamics/planar.hpp"

namespace polynya::dynamics {
// Rudders behind propellers, derived in docs/theory/ship.md. A positive angle turns a ship that goes ahead to port.

/// Rudder blades of one size, all at one angle. Either each stands behind its own propeller, or none is behind one.
struct Rudder {
  double area = 0;                  ///< A_R of all blades together [m²]
  int count = 1;                    ///< number of blades [-]
  double aspect_ratio = 1.5;        ///< Λ, height over chord of a blade [-]
  double position = 0;              ///< x_R of the blades from the centre of gravity [m]
  double propeller_area = 0;        ///< A_P, disc of the propeller ahead of each blade; 0: there is none [m²]
  double thrust_share = 1;          ///< fraction of the ship's thrust that this propeller has [-]
  bool has_nozzle = false;          ///< the propeller is ducted: its race does not contract
  double wake_fraction = 0.2;       ///< w: the hull drags water along with this fraction of its speed [-]
  double flow_straightening = 0.6;  ///< γ: fraction of the cross velocity at the stern that reaches the blades [-]
  double hull_factor = 0.3;         ///< a_H: side force on the hull over that on the blade, in the hull's flow [-]
};

/// The flow behind a propeller at the rudder.
struct Race {
  double speed = 0;     ///< V, of the blade through this water; negative: the water comes from astern [m/s]
  double diameter = 0;  ///< [m]
};

/// Returns the race of an actuator disc, fully contracted and not yet mixed with the water around it. `advance` is the
/// speed of the propeller ahead through the flow of the hull [m/s], `thrust` its thrust [N], `density` the density of
/// the water [kg/m³].
Race race_behind(double propeller_area, bool has_nozzle, double thrust, double advance, double density);

/// Lift across the flow and drag along it, without dimension.
struct LiftAndDrag {
  double lift = 0;
  double drag = 0;
};

/// Returns lift and drag of a blade in an endless flow, over ½ρ V² A. Up to the stall angle they follow
/// [WhickerFehlner1958]. Beyond 1.25 times that angle the blade is a plate from which the flow has broken off.
/// @param aspect_ratio Λ_e, effective height over chord [-].
/// @param incidence α, from the blade's chord to its velocity through the water [rad]; of any size.
LiftAndDrag foil_in_endless_flow(double aspect_ratio, double incidence);

/// Returns lift and drag of a blade in a race through still water, over the momentum flow ρ V² π d²/4 of the part of
/// the race that is as thick as the blade in it is high, d. The blade turns the race by an angle below its own; beyond
/// stall it is a plate on which the race impinges. The water never leaves with more momentum than it had.
/// @param aspect_ratio d over the chord [-].
LiftAndDrag foil_in_race(double aspect_ratio, double incidence);

/// Returns the force of all blades on the ship, including the reaction of the hull.
/// @param angle δ of the blades [rad].
/// @param through_water velocity of the ship through the water [m/s, rad/s].
/// @param thrust of all propellers, ahead [N]. Propellers that push astern have no race on the rudder.
/// @param density of the water [kg/m³].
Planar rudder_force(const Rudder& rudder, double angle, Planar through_water, double thrust, double density);

}  // namespace polynya::dynamics
