#pragma once

#include "dynamics/bodies.hpp"

namespace polynya::simulation {

/// Where the energy of the bodies' motion in the plane came from and went, summed over all steps [J]. In the
/// water frame, of everything whose motion is not prescribed. Each entry is measured where it happens; that
/// they account for the kinetic energy is audited, not arranged (audit).
struct EnergyFlows {
  double thrust = 0;         ///< in: by thrust and moorings, and by bodies of prescribed motion
  double current = 0;        ///< in: by a sheared current carrying ice along
  double drag = 0;           ///< out: to the water around, of ships with the inertia that it has
  double friction = 0;       ///< out: along contact lines
  double restitution = 0;    ///< out: across contact lines that did not crush, which restitution does not return
  double crushing = 0;       ///< out: across contact lines that pressed with all that crushing ice carries
  double bending = 0;        ///< out: the motion of the cusps and brash that bending took out of the floe list
  double splitting = 0;      ///< out: the same of splits
  double grinding = 0;       ///< out: the same of overlaps that were ground to brash
  double submersion = 0;     ///< out: the motion of ice that went under a hull
  double submerged_ice = 0;  ///< out: of ships, to the ice under their hulls
  double rest = 0;           ///< out: what was left to floes that came to rest
};

/// Impulses from outside on everything free to move, summed over all steps [N s]. In the water frame.
struct MomentumFlows {
  geometry::Vector thrust;   ///< of ships' propellers
  geometry::Vector held;     ///< of moorings, and through contacts with bodies of prescribed motion
  geometry::Vector water;    ///< of drag and current, on hulls and rudders, and of the ice under hulls
  geometry::Vector removed;  ///< with what left the floe list, and what rest took
};

/// What wind and walls that press did, summed over all steps. All 0 in scenes without them, whose states do
/// not have it.
struct BoundaryFlows {
  double wind = 0;                ///< energy in, by the wind on the ice [J]
  double walls = 0;               ///< energy in, by the loads of walls, less what damps and holds them [J]
  geometry::Vector wind_impulse;  ///< on floes [N s]
  geometry::Vector wall_impulse;  ///< on walls, of the same [N s]
};

struct AuditSums {
  double initial_energy = 0;          ///< [J]
  geometry::Vector initial_momentum;  ///< [N s]
  double impulses = 0;                ///< sum of the sizes of all impulses from outside [N s]
  EnergyFlows energy;
  MomentumFlows momentum;
  BoundaryFlows boundaries;
};

/// The accounts at one instant.
struct Audit {
  AuditSums sums;
  double kinetic_energy = 0;            ///< at that instant [J]
  double turnover = 0;                  ///< all energy that flowed, and the initial [J]
  double energy_imbalance = 0;          ///< kinetic − initial − in + out [J]
  geometry::Vector total_momentum;      ///< at that instant [N s]
  double momentum_turnover = 0;         ///< all impulses' sizes, and the initial [N s]
  geometry::Vector momentum_imbalance;  ///< [N s]

  /// The accounts close to this share of the turnover, or something is wrong.
  static constexpr double kTolerance = 1e-6;
  bool is_closed() const;
};

double kinetic_energy(const dynamics::Bodies& bodies);      ///< of all that is alive and free to move [J]
geometry::Vector momentum(const dynamics::Bodies& bodies);  ///< of the same [N s]

/// Opens the accounts, before the first step.
void open_accounts(const dynamics::Bodies& bodies, AuditSums& sums);

/// Enters the motion of a floe: its energy into one of the sums' flows [J], its momentum into another [N s].
void enter_motion(const dynamics::Bodies& bodies, dynamics::BodyIndex floe, double& energy, geometry::Vector& momentum,
                  AuditSums& sums);

/// Stops a floe: its energy goes to the sink, one of the sums' flows [J], its momentum to what was removed.
void stop(dynamics::Bodies& bodies, dynamics::BodyIndex floe, double& energy_sink, AuditSums& sums);

/// Closes the sums against the bodies' kinetic energy [J] and momentum [N s].
Audit audit(const AuditSums& sums, double kinetic_energy, geometry::Vector momentum);

}  // namespace polynya::simulation
