#pragma once

#include "dynamics/bodies.hpp"

namespace polynya::simulation {

/// Energy that flowed into and out of the motion of the bodies in the plane, summed over all steps [J]. The energy is
/// the kinetic energy in the water frame of all bodies whose motion is not prescribed. Each flow is measured where it
/// happens. Whether all flows together explain the kinetic energy is checked by audit(); no entry is computed from the
/// others.
struct EnergyFlows {
  /// Inflow: work of propellers, of constant thrust, of forces from outside (World::external_forces) and of bodies of
  /// prescribed motion, fast ice included; and the kinetic energy of pieces that break off fast ice. The work of
  /// moorings is in MooringFlows.
  double thrust = 0;
  /// Inflow: work of a sheared current that carries ice along, and the kinetic energy that it gives to pieces that
  /// surface.
  double current = 0;
  /// Outflow: work lost to the surrounding water by drag on floes and by the water's forces on hulls and rudders, which
  /// include the inertia of the water around a ship.
  double drag = 0;
  /// Outflow: work of Coulomb friction along contact lines.
  double friction = 0;
  /// Outflow: work of the normal impulses of contacts that did not press with the full force of crushing ice. It is the
  /// energy that restitution does not return, and negative where such contacts return stored energy.
  double restitution = 0;
  /// Outflow: work of the normal impulses of contacts that pressed with the full force of crushing ice.
  double crushing = 0;
  /// Outflow: kinetic energy of the ice that became brash or went under for good when a cusp broke off.
  double bending = 0;
  /// Outflow: kinetic energy of the ice that became brash when a floe split.
  double splitting = 0;
  /// Outflow: kinetic energy of the ice that became brash when an overlap was cut off a floe.
  double grinding = 0;
  /// Outflow: kinetic energy of ice when it goes under a hull, and the work of ships on cusps that they press down.
  double submersion = 0;
  /// Outflow: work of ships on the ice that lies under their hulls.
  double submerged_ice = 0;
  /// Outflow: kinetic energy that floes still had when they were put to sleep.
  double rest = 0;
};

/// External impulses on all bodies whose motion is not prescribed, in the water frame, summed over all steps [N s].
struct MomentumFlows {
  /// Impulse of the propellers, of constant thrust and of forces from outside on ships [N s].
  geometry::Vector thrust;
  /// Impulse of moorings, of contacts with bodies of prescribed motion, and the momentum of pieces that break off fast
  /// ice [N s].
  geometry::Vector held;
  /// Impulse of the water: drag and current on floes, forces on hulls and rudders, the pull of ice under hulls and of
  /// cusps that hulls press down, and the momentum of pieces that surface [N s].
  geometry::Vector water;
  /// Momentum of ice that left the floe list, went under a hull or was put to sleep; an outflow [N s].
  geometry::Vector removed;
};

/// Energy and impulses of the wind and of walls that press, summed over all steps. All entries are 0 in a scene without
/// wind and without such walls; saved states of such a scene do not contain them.
struct BoundaryFlows {
  /// Inflow of energy: work of the wind on floes [J].
  double wind = 0;
  /// Inflow of energy: work of the loads on walls, minus the work of the damping and of the constraint that keeps
  /// each wall on its normal [J]. It contains the change of the walls' kinetic energy in the water frame when the
  /// frame is accelerated.
  double walls = 0;
  geometry::Vector wind_impulse;  ///< impulse of the wind on floes [N s]
  geometry::Vector wall_impulse;  ///< impulse on walls that press, of everything that `walls` contains [N s]
};

/// Energy of moorings, summed over all steps [J]. What they store at an instant follows from where their ships are
/// (stored_in_moorings, ship/mooring.hpp); the balance therefore uses neither `taken_up` nor `given_back`, which count
/// only in AuditSums::exchanged. All entries are 0 in a scene without moorings.
struct MooringFlows {
  double initial = 0;     ///< energy stored before the first step
  double taken_up = 0;    ///< work that ships did on springs in steps in which these took up energy, ≥ 0
  double given_back = 0;  ///< work of springs on ships in the other steps, ≥ 0
  double ground = 0;      ///< inflow: work of the ground, which moves in the water frame, through moorings on ships
  double damping = 0;     ///< outflow: work of ships on the dampers of moorings
  double breaking = 0;    ///< outflow: energy that moorings stored when they broke
  double separation = 0;  ///< inflow: change of the stored energy when separate_overlaps() moves ships
};

/// Sums from which an audit is made: the state at the start and all flows since then.
struct AuditSums {
  double initial_energy = 0;          ///< kinetic energy before the first step [J]
  geometry::Vector initial_momentum;  ///< momentum before the first step [N s]
  double initial_momenta = 0;         ///< sum of the magnitudes of all bodies' momenta before the first step [N s]
  double impulses = 0;                ///< sum of the magnitudes of all external impulses [N s]
  /// Sum over all steps and all flows of energy of the magnitude of the flow in the step [J]. What flows to and fro
  /// counts each time.
  double exchanged = 0;
  EnergyFlows energy;
  MomentumFlows momentum;
  BoundaryFlows boundaries;
  MooringFlows moorings;
};

/// Energy and momentum at one instant, in the water frame, of all bodies that exist and whose motion is not prescribed,
/// and of moorings.
struct Holdings {
  double kinetic_energy = 0;  ///< kinetic energy [J]
  double stored_energy = 0;   ///< energy stored in moorings [J]
  geometry::Vector momentum;  ///< sum of the bodies' momenta [N s]
  double momenta = 0;         ///< sum of the magnitudes of the bodies' momenta [N s]
};

/// Balance of energy and momentum at one instant.
struct Audit {
  AuditSums sums;
  double kinetic_energy = 0;  ///< kinetic energy at that instant [J]
  double stored_energy = 0;   ///< energy stored in moorings at that instant [J]
  /// Scale for the energy imbalance: the kinetic and stored energy at the start and all that was exchanged since,
  /// AuditSums::exchanged [J].
  double turnover = 0;
  /// Kinetic and stored energy − the same at the start − inflows + outflows; ideally 0 [J].
  double energy_imbalance = 0;
  geometry::Vector total_momentum;  ///< momentum at that instant [N s]
  /// Scale for the momentum imbalance: the magnitudes of all bodies' momenta at the start and at that instant, and of
  /// all external impulses [N s]. Momenta that cancel and forces to and fro count.
  double momentum_turnover = 0;
  geometry::Vector momentum_imbalance;  ///< momentum − initial momentum − inflows + outflow; ideally 0 [N s]

  /// Largest imbalance, as a fraction of the turnover, at which the balance counts as closed [-]. A larger value hides
  /// flows that are not measured; a much smaller one reports rounding as an error.
  static constexpr double kTolerance = 1e-6;
  /// Returns true if the imbalances of energy and momentum are both within kTolerance.
  bool is_closed() const;
};

/// Returns the kinetic energy of all bodies that exist and whose motion is not prescribed, in the water frame [J].
double kinetic_energy(const dynamics::Bodies& bodies);
/// Returns the momentum of the same bodies, in the water frame [N s].
geometry::Vector momentum(const dynamics::Bodies& bodies);
/// Returns energy and momentum of the same bodies and of the moorings. `stored_energy` is the energy that the moorings
/// store [J].
Holdings holdings(const dynamics::Bodies& bodies, double stored_energy);

/// Sets all sums to 0 and stores energy and momentum at the start. Called once, before the first step.
void open_accounts(const Holdings& holdings, AuditSums& sums);

/// Adds the magnitude of the change of each energy flow since `before` to AuditSums::exchanged. Called after each step,
/// and after the other changes of the flows, at the start of the run and at the end of each tick.
void enter_exchange(const AuditSums& before, AuditSums& sums);

/// Adds the kinetic energy of a floe to `energy` [J] and its momentum to `momentum` [N s]. Both are members of the
/// flows in `sums`; the magnitude of the momentum is added to AuditSums::impulses.
void enter_motion(const dynamics::Bodies& bodies, dynamics::BodyIndex floe, double& energy, geometry::Vector& momentum,
                  AuditSums& sums);

/// Sets the velocity of a floe to 0. If the floe's motion is not prescribed, its kinetic energy is added to
/// `energy_sink`, one of the flows in `sums` [J], and its momentum to MomentumFlows::removed.
void stop(dynamics::Bodies& bodies, dynamics::BodyIndex floe, double& energy_sink, AuditSums& sums);

/// Returns the balance of the sums with the present energy and momentum.
Audit audit(const AuditSums& sums, const Holdings& holdings);

}  // namespace polynya::simulation
