#pragma once

#include "geometry/shape/point.hpp"

namespace polynya::simulation {

struct World;

/// Where the energy of the bodies' motion in the plane came from and went, summed over all steps [J]. In the
/// water frame, of everything that is not held. Each entry is measured where it happens; that they account
/// for the kinetic energy is audited, not arranged (audit).
struct EnergyFlows {
  double thrust = 0;    ///< in: by thrust, and by what holds a ship to its speed or a structure in its place
  double current = 0;   ///< in: by a sheared current carrying ice along
  double drag = 0;      ///< out: relative to the water around
  double friction = 0;  ///< out: along contact lines
  double restitution = 0;  ///< out: across contact lines that did not crush, what they do not give back
  double crushing = 0;     ///< out: across contact lines that pressed with all that crushing ice carries
  double bending = 0;      ///< out: the motion of the cusps and crumbs that bending took out of the floe list
  double splitting = 0;    ///< out: the same of splits
  double rest = 0;         ///< out: what was left to floes that came to rest
};

/// Impulses from outside on everything that is not held, summed over all steps [N s]. In the water frame.
struct MomentumFlows {
  geometry::Vector thrust;   ///< of ships' propellers
  geometry::Vector held;     ///< through contacts with what is held
  geometry::Vector water;    ///< of drag and current
  geometry::Vector removed;  ///< with what left the floe list, and what rest took
};

struct AuditSums {
  double initial_energy = 0;          ///< [J]
  geometry::Vector initial_momentum;  ///< [N s]
  double impulses = 0;                ///< sum of the sizes of all impulses from outside [N s]
  EnergyFlows energy;
  MomentumFlows momentum;
};

/// The accounts at one moment.
struct Audit {
  AuditSums sums;
  double kinetic_energy = 0;            ///< at the moment [J]
  double turnover = 0;                  ///< all energy that flowed, and the initial [J]
  double energy_imbalance = 0;          ///< kinetic − initial − in + out [J]
  geometry::Vector total_momentum;      ///< at the moment [N s]
  double momentum_turnover = 0;         ///< all impulses' sizes, and the initial [N s]
  geometry::Vector momentum_imbalance;  ///< [N s]

  /// The accounts close to this share of the turnover, or something is wrong.
  static constexpr double kTolerance = 1e-6;
  bool is_closed() const;
};

double kinetic_energy(const World& world);      ///< of all that is alive and not held [J]
geometry::Vector momentum(const World& world);  ///< of the same [N s]

/// Opens the accounts, before the first step.
void open_accounts(World& world);
Audit audit(const World& world);
/// The same of what is known of a world: its sums, its kinetic energy [J] and its momentum [N s].
Audit audit(const AuditSums& sums, double kinetic_energy, geometry::Vector momentum);

}  // namespace polynya::simulation
