#pragma once

#include "dynamics/planar.hpp"
#include "simulation/ship/sailing_settings.hpp"
#include "simulation/world/clock.hpp"
#include "simulation/world/population.hpp"
#include "simulation/world/setup.hpp"

namespace polynya::simulation {

/// A force that is linear in a ship's velocity ν at the end of a step: F = k − D (ν − w), in the ship's axes.
struct LinearForce {
  dynamics::Planar constant;       ///< k [N, N m]
  dynamics::PlanarMatrix damping;  ///< D [N s/m, N m s/rad]
  dynamics::Planar against;  ///< w, velocity of the water, current or ground against which the force acts [m/s, rad/s]
  dynamics::Planar at(dynamics::Planar velocity) const { return constant - damping * (velocity - against); }
};

/// Displacement of a ship from its moored place, in the axes of the moored heading.
struct Offset {
  geometry::Vector shift;  ///< displacement along and across the moored heading [m]
  double turn = 0;         ///< turn from the moored heading, counter-clockwise [rad]
};

/// A moored ship at the start of a step.
struct MooredShip {
  geometry::Rotation rotation;  ///< rotation of the ship
  double mass = 0;              ///< mass of the ship [kg]
  double moment = 0;            ///< moment of inertia of the ship [kg m²]
  dynamics::Planar now;         ///< velocity ν after the step's other impulses, in the water frame [m/s, rad/s]
  dynamics::Planar of_ground;   ///< velocity u of the ground in the water frame [m/s, rad/s]
};

/// The forces of a mooring, averaged over a step.
struct MooringForce {
  LinearForce spring;
  LinearForce damper;
};

/// Returns the offset of a ship whose centre of gravity is at `place` over ground, turned by `angle` [rad].
Offset offset_from(const MooringSettings& mooring, geometry::Point place, double angle);

/// Returns the mean force of a mooring over a step of length Δt [s]:
///   spring  −K x̄,  x̄ = x + ½Δt (ν̄ − u),  ν̄ = ½(ν + ν⁺),
///   damper  −C [(1 − θ)(ν − u) + θ(ν⁺ − u)],  θ = max(½, 1 − m/(Δt C)) for each axis,
/// with the offset x at the start, the ship's velocity ν before and ν⁺ after the impulses of sail(), and the velocity u
/// of the ground. It is the implicit midpoint rule if the ship moves by Δt ν̄ (move_by_mean in sailing.cpp): second
/// order in time, stable for any K, C and Δt, and the spring conserves ½m ν² + ½K x². θ > ½, where Δt C > 2m, keeps a
/// stiff damper from reversing the velocity (docs/theory/ship.md).
MooringForce mooring_force(const MooringSettings& mooring, const Offset& offset, const MooredShip& ship, double dt);

/// Returns the energy ½(k_x x² + k_y y² + k_ψ ψ²) that a mooring stores at an offset [J].
double stored_energy(const MooringSettings& mooring, const Offset& offset);

/// Returns true if a ship has a mooring that holds.
bool is_moored(const Setup& setup, const Population& population, BodyIndex ship);

/// Returns the energy stored in all moorings that hold [J]. `drift` is the displacement of the water frame [m].
double stored_in_moorings(const Setup& setup, const Population& population, geometry::Vector drift);

/// Returns the energy that the moorings will store at the end of the step if the bodies keep their velocities [J].
double stored_after(const Setup& setup, const Step& step, const Population& population);

}  // namespace polynya::simulation
